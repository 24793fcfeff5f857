#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "systems/extract/snapshot.h"

namespace gnomon::lighting {

/// Uniform block; matches FogBlock in shaders/lighting/fog/fog_way.glsl (std140).
struct FogRecord {
    glm::vec4 to_box[3]{};
    glm::vec4 taken{0.0f};
    glm::vec4 marks{0.0f};
};
static_assert(sizeof(FogRecord) == 80);

/// Returns the record of a box of fog for a camera at `anchor_ws_m`. `noise_round`: LightingSettings::noise_round.
FogRecord fog_record(const FogItem& fog, const InstanceItem& box, const glm::dvec3& anchor_ws_m,
                     std::uint32_t noise_round);

}  // namespace gnomon::lighting
