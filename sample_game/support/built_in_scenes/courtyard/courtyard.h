#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace gnomon::game {

struct CourtyardOptions {
    glm::dvec3 offset_m{0.0};  // where the courtyard's origin lies in the world; finite
    double scale = 1.0;        // size, finite, > 0; candela, ranges and clip planes follow, so that the picture stays
    bool casters = true;       // false: every mesh has extras.castShadow = false
    bool game = false;         // true: also the player, two screens to hide behind, a parapet and the gate to reach
};

struct Courtyard {
    std::vector<std::byte> glb;
    std::uint64_t triangles = 0;  // over all nodes
};

/// Makes the built-in scene as binary glTF: a courtyard of about 20 x 20 m at dusk, with moving casters. Lights: a sun,
/// a swinging lantern (point) and a sweeping guard lamp (spot). Cameras: "main", "top", "low". Same options, same
/// bytes.
Courtyard make_courtyard(const CourtyardOptions& options = {});

}  // namespace gnomon::game
