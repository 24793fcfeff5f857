#pragma once
#include <array>
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

/// As many sides as a pyramid around a cone has: its corners stand off the cone by 1 / cos(pi / 12), 3.5 %.
inline constexpr std::size_t kConeSides = 12;

/// Planes that touch the cone all around, and the one behind its apex: a box outside one of them has no point in the
/// cone. The same for every box, so that none is outside of which a part is not (BoundsTree::visit).
std::array<Plane, kConeSides + 1> planes_around(const Cone& cone);

/// `outside` only if no point of the box is in the ball, `inside` only if all are, up to rounding; an infinite radius
/// holds everything.
Overlap overlap_ball(const glm::dvec3& centre, double radius, const Aabb& box);

}  // namespace gnomon::math
