#pragma once
#include <cstdint>

#include "gnomon/light.h"

namespace gnomon::shadow {

/// Largest number of views of one light: cascades, or cube faces beside a spot's single view. Equals kMaxViews of
/// shaders/shadow/lookup/light_block.glsl.
inline constexpr std::uint32_t kMaxViews = 8;
static_assert(kMaxViews >= kMaxCascades);

}  // namespace gnomon::shadow
