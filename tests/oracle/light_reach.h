#pragma once
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "systems/extract/light_facts.h"
#include "systems/extract/snapshot.h"

namespace gnomon::oracle {

/// Computes the direction to the light's middle and the ray parameter there. Returns false outside the light's range or
/// cone, or behind its plane.
inline bool reach(const LightItem& light, const glm::dvec3& light_rel_m, const glm::dvec3& point_rel_m,
                  glm::dvec3& to_light, double& t_max) {
    if (light.kind == LightKind::directional) {
        to_light = light.rotation_ws[2];
        t_max = std::numeric_limits<double>::infinity();
        return true;
    }
    to_light = light_rel_m - point_rel_m;
    t_max = 1.0;
    const double distance_m = glm::length(to_light);
    if (!(distance_m > 0.0)) return false;
    if (light.range_m > 0.0 && distance_m > light.range_m) return false;
    if (light.kind != LightKind::spot) return is_shone_on(light, to_light);
    const double cosine = glm::dot(to_light, light.rotation_ws[2]) / (distance_m * glm::length(light.rotation_ws[2]));
    return cosine >= std::cos(light.outer_cone_rad);
}

inline double cosine_between(const glm::dvec3& unit_normal, const glm::dvec3& to_light) {
    return glm::dot(unit_normal, to_light) / glm::length(to_light);
}

/// Returns two axes in the plane of a unit normal.
inline std::array<glm::dvec3, 2> tangents(const glm::dvec3& n) {
    const glm::dvec3 helper = std::abs(n.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 first = glm::normalize(glm::cross(n, helper));
    return {first, glm::cross(n, first)};
}

}  // namespace gnomon::oracle
