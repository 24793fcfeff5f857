#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "systems/extract/snapshot.h"

namespace gnomon::lighting {

/// Uniform block; matches AmbientBlock in shaders/lighting/lights/ambient.glsl (std140).
struct AmbientRecord {
    glm::vec4 sky_lux{0.0f}, ground_lux{0.0f};
};

/// Place and size of a scene: medians over its instances. A ground of any width thus does not define the scene's size.
struct Midst {
    glm::dvec3 middle_ws_m{0.0};
    double reach_m = 0.0;  // 0: empty scene
};

/// Finds the midst of a scene; caches it while the scene does not change.
class MidstFinder {
public:
    const Midst& find(const SceneSnapshot& scene);

private:
    double middle_of(const SceneSnapshot& scene, int axis);

    Midst midst_;
    std::uint64_t version_ = 0;  // version of the scene; 0: none
    std::vector<double> scratch_;
};

/// Incident light of a scene: basis of its ambient light and of its picture's brightness.
struct SceneLight {
    double suns_lux = 0.0;   // all suns, in their strongest channel
    double lamps_lux = 0.0;  // all spots and points at the scene's distance from each
    glm::vec3 sky_lux{0.0f};
    glm::vec3 bounce_lux{0.0f};
};
SceneLight scene_light(const SceneSnapshot& scene, const Midst& midst);

/// Computes ambient light for a scene without any: a share of its lights, bluish from above. Scaled by `per_radiance`,
/// a power of two. Finite; w is 0.
AmbientRecord ambient_for(const SceneLight& light, float per_radiance = 1.0f);

}  // namespace gnomon::lighting
