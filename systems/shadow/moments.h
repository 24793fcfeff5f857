#pragma once
#include <array>
#include <cstdint>
#include <glm/vec4.hpp>

#include "components/light_shadow.h"
#include "engine/gl/device.h"

namespace gnomon::shadow {

struct FilterRow;

inline constexpr std::uint32_t kMostMomentLevels = 4, kMostMomentAnisotropy = 16;
/// Beyond, next to nothing is left of a penumbra.
inline constexpr float kMostMomentBleeding = 0.9f;

/// What a prefiltered map is made and read with: a light's settings as its filter's format bears them.
struct MomentDemand {
    gl::Format format = gl::Format::r32f;
    /// As shaders/shadow/filters have them. x, y: exponents of the two warps; z: MomentStore::least; w: 1 if moments
    /// are stored in 16 bits.
    glm::vec4 settings{0.0f};
    float bleeding = 0.0f;
    std::uint32_t levels = 1, anisotropy = 1;
    bool sampler_anisotropy = true;  // whether that is the sampler's; if not, the lookup's: see kinds/point.glsl
    /// Most texels that a pixel is taken to cover along a side; 1: the map is read as finely as it is.
    float footprint_texel = 1.0f;
    /// What that adds to E.
    float reach_texel = 0.0f;
    bool cut = false;  // not all is as asked for
    bool operator==(const MomentDemand&) const = default;
};

/// Levels of mipmaps whose coarsest texel is as wide as that radius, or up to half of it.
std::uint32_t widest_penumbra_levels(float radius_texel);

/// Of a row of FilterStorage::moments; of any other the default. A map that is too small for so many levels gets fewer.
MomentDemand moment_demand(const FilterRow& row, const LightShadow& shadow, std::uint32_t resolution_px);

/// Weights of a Gaussian blur over `size` texels (odd), from the middle outward; the two sides of it sum up to 1. It is
/// cut off at two standard deviations, half a texel beyond the last.
inline constexpr std::uint32_t kMomentWeights = 16;
std::array<float, kMomentWeights> blur_weights(std::uint32_t size);

}  // namespace gnomon::shadow
