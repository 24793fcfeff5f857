#pragma once
#include <glm/vec3.hpp>

#include "engine/math/aabb.h"
#include "engine/math/frustum.h"

namespace gnomon::math {

/// Solid, without an end.
struct Cone {
    glm::dvec3 apex{0.0};
    glm::dvec3 axis{0.0, 0.0, -1.0};  // unit
    double half_angle_rad = 0.0;      // above 0, at most half pi
};

/// `outside` only if no point of the box is in the cone, `inside` only if all are, up to rounding. Between, it may err
/// to `partial`: the box is told apart by the planes that touch the cone behind the apex and on the side of the box.
Overlap overlap(const Cone& cone, const Aabb& box);

/// The same for a ball; an infinite radius holds everything.
Overlap overlap_ball(const glm::dvec3& centre, double radius, const Aabb& box);

}  // namespace gnomon::math
