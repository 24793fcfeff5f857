#pragma once
#include <cstdint>

#include "gnomon/light.h"

namespace gnomon::shadow {

/// Largest number of views of one light: cascades, or cube faces beside a spot's single view. Equals kMaxViews of
/// shaders/shadow/lookup/light_block.glsl.
inline constexpr std::uint32_t kMaxViews = 8;
static_assert(kMaxViews >= kMaxCascades);

/// View record that carries an area light's source in place of a view: kSourceView of
/// shaders/shadow/lookup/source_place.glsl. Cubes leave it free.
inline constexpr std::uint32_t kSourceView = kMaxViews - 1;

}  // namespace gnomon::shadow
