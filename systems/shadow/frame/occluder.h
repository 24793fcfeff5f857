#pragma once
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "engine/math/aabb.h"

namespace gnomon::shadow {

/// Box inside of an opaque instance that a camera sees. No pixel shows what lies behind the box.
struct Occluder {
    std::uint32_t instance = 0;  // index into SceneSnapshot::instances
    double size_rad = 0.0;       // how large it looks: the diagonal of the instance's bounds over their distance
    glm::dvec3 eye_ws_m{0.0};    // the camera's place
    glm::dvec3 eye_ms{0.0};      // the same in the mesh's space
    glm::dmat3 from_world{1.0};  // world to mesh axes
    math::Aabb box_ms;           // smaller than the instance's inner box by what rasterising may round
};

}  // namespace gnomon::shadow
