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
/// Largest share of light that may count as dark. Beyond it almost no penumbra remains.
inline constexpr float kMostMomentBleeding = 0.9f;

/// Returns the number of mipmap levels, the finest included, with a coarsest texel above half of radius_texel and at
/// most as wide.
std::uint32_t widest_penumbra_levels(float radius_texel);

/// Returns the effective settings of a row with FilterRow::moments; the default for other rows. Levels and anisotropy
/// are reduced until the footprint fits into a map of resolution_px.
PrefilterSettings prefilter_settings(const FilterRow& row, const LightItem& light, std::uint32_t resolution_px);

/// Largest number of weights of a blur, from the middle to one side.
inline constexpr std::uint32_t kMomentWeights = 16;
/// Returns weights of a Gaussian blur over `size` texels (odd), from the middle outward. The sum over both sides is 1.
/// The Gaussian is cut off at two standard deviations, half a texel beyond the last weight.
std::array<float, kMomentWeights> blur_weights(std::uint32_t size);

}  // namespace gnomon::shadow
