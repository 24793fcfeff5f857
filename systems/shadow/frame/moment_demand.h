#pragma once
#include <cstdint>
#include <glm/vec4.hpp>

#include "engine/gl/device.h"

namespace gnomon::shadow {

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

}  // namespace gnomon::shadow
