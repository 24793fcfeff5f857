#pragma once
#include <array>
#include <cstdint>
#include <glm/vec4.hpp>

#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"

namespace gnomon::shadow {

struct FilterRow;

inline constexpr std::uint32_t kMostMomentLevels = 4, kMostMomentAnisotropy = 16;
/// Beyond, next to nothing is left of a penumbra.
inline constexpr float kMostMomentBleeding = 0.9f;

/// Levels of mipmaps whose coarsest texel is as wide as that radius, or up to half of it.
std::uint32_t widest_penumbra_levels(float radius_texel);

/// Of a row with FilterRow::moments; of any other the default. A map that is too small for so many levels gets fewer.
PrefilterSettings prefilter_settings(const FilterRow& row, const LightItem& light, std::uint32_t resolution_px);

/// Weights of a Gaussian blur over `size` texels (odd), from the middle outward; the two sides of it sum up to 1. It is
/// cut off at two standard deviations, half a texel beyond the last.
inline constexpr std::uint32_t kMomentWeights = 16;
std::array<float, kMomentWeights> blur_weights(std::uint32_t size);

}  // namespace gnomon::shadow
