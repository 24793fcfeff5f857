#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "systems/extract/snapshot.h"

namespace gnomon::lighting {

/// Matches AmbientBlock in shaders/lighting/lights/ambient.glsl (std140).
struct AmbientRecord {
    glm::vec4 sky_lux{0.0f}, ground_lux{0.0f};
};

/// Where half of what stands in a scene stands: as many instances reach beyond it as do not, so that no ground, however
/// wide, is the scene's size.
struct Midst {
    glm::dvec3 middle_ws_m{0.0};
    double reach_m = 0.0;  // 0: nothing stands there
};

/// Finds the midst of a scene; keeps it while the scene stays as it is.
class MidstFinder {
public:
    const Midst& find(const SceneSnapshot& scene);

private:
    double middle_of(const SceneSnapshot& scene, int axis);

    Midst midst_;
    std::uint64_t version_ = 0;  // of the scene; 0: none
    std::vector<double> scratch_;
};

/// What falls on a scene, by its lights: the basis of its ambient light, and of how bright its picture will be.
struct SceneLight {
    double suns_lux = 0.0;   // of all suns, in their strongest colour
    double lamps_lux = 0.0;  // of all spots and points, at the scene's own distance from each
    glm::vec3 sky_lux{0.0f};
    glm::vec3 bounce_lux{0.0f};
};
SceneLight scene_light(const SceneSnapshot& scene, const Midst& midst);

/// Ambient light for a scene that brings none: a share of what its lights give, bluish from above. Times
/// `per_radiance`, a power of two; w is 0. Finite.
AmbientRecord ambient_for(const SceneLight& light, float per_radiance = 1.0f);

}  // namespace gnomon::lighting
