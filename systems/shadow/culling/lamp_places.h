#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "systems/extract/snapshot.h"

namespace gnomon::shadow {

/// Returns the position from which a local light's maps see the scene. `lamps_ws_m`: output of LampOffsets. Empty: the
/// lights' own positions.
inline const glm::dvec3& lamp_ws_m(std::span<const glm::dvec3> lamps_ws_m, const SceneSnapshot& scene,
                                   std::uint32_t light) {
    return light < lamps_ws_m.size() ? lamps_ws_m[light] : scene.lights[light].position_ws_m;
}

}  // namespace gnomon::shadow
