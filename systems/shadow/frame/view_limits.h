#pragma once
#include <cstdint>

#include "components/light_shadow.h"

namespace gnomon::shadow {

/// Most views of one light: cascades, or faces and a spot's view beside them. kMaxViews of
/// shaders/shadow/lookup/light_block.glsl.
inline constexpr std::uint32_t kMaxViews = 8;
static_assert(kMaxViews >= kMaxCascades);

}  // namespace gnomon::shadow
