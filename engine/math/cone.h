#pragma once
#include <array>
#include <glm/vec3.hpp>

#include "engine/math/aabb.h"
#include "engine/math/frustum.h"

namespace gnomon::math {

/// Solid cone without an end.
struct Cone {
    glm::dvec3 apex{0.0};
    glm::dvec3 axis{0.0, 0.0, -1.0};  // unit vector
    double half_angle_rad = 0.0;      // (0, pi / 2]
};

/// Number of sides of a pyramid around a cone. Its corners lie outside the cone by a factor of 1 / cos(pi / 12), 3.5 %.
inline constexpr std::size_t kConeSides = 12;

/// Returns planes that touch the cone all around, and one behind its apex. A box outside one of them has no point in
/// the cone. The planes are the same for every box, so that results are consistent for BoundsTree::visit.
std::array<Plane, kConeSides + 1> planes_around(const Cone& cone);

/// Returns directions along the edges between those planes. Their sums with positive weights hold the cone, which is
/// narrower than pi / 2.
std::array<glm::dvec3, kConeSides> edges_around(const Cone& cone);

/// Classifies a box against a ball. `outside` only if no point of the box lies in the ball, `inside` only if all do, up
/// to rounding. A ball with infinite radius contains everything.
Overlap overlap_ball(const glm::dvec3& centre, double radius, const Aabb& box);

}  // namespace gnomon::math
