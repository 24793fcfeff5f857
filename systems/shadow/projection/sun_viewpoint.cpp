#include "systems/shadow/projection/sun_viewpoint.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/math/aabb.h"
#include "systems/shadow/projection/cube_faces.h"

namespace gnomon::shadow {

bool is_eye(const ShadowTuning::Projection& tuning) {
    return tuning.eye_distance_m >= 0.0f && std::isfinite(tuning.eye_distance_m) && tuning.eye_angle_rad > 0.0f &&
           static_cast<double>(tuning.eye_angle_rad) <= 2.0 * kWidestMap_rad;
}

SunViewpoint sun_viewpoint(const glm::dmat3& light_basis, std::span<const glm::dvec3> points_ws,
                           const ShadowTuning::Projection& tuning) {
    math::Aabb box;
    for (const glm::dvec3& p : points_ws) box = math::extended(box, (p - points_ws.front()) * light_basis);
    const glm::dvec3 middle_ws = points_ws.front() + light_basis * math::centre(box);
    SunViewpoint eye;
    eye.distance_m = static_cast<double>(tuning.eye_distance_m);
    if (eye.distance_m == 0.0) {
        double radius_m = 0.0;
        for (const glm::dvec3& p : points_ws) radius_m = std::max(radius_m, glm::distance(p, middle_ws));
        eye.distance_m = radius_m / std::sin(0.5 * static_cast<double>(tuning.eye_angle_rad));
    }
    eye.position_ws_m = middle_ws + light_basis[2] * eye.distance_m;
    return eye;
}

}  // namespace gnomon::shadow
