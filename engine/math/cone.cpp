#include "engine/math/cone.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace gnomon::math {
namespace {

/// Of coordinates of this size, differences are wrong by a few of their last bits: the same bound as in frustum.cpp.
double rounding(const glm::dvec3& p, const Aabb& box) {
    const glm::dvec3 largest = glm::max(glm::abs(p), glm::max(glm::abs(box.min), glm::abs(box.max)));
    return 0x1p-48 * (largest.x + largest.y + largest.z);
}

}  // namespace

Overlap overlap(const Cone& cone, const Aabb& box) {
    if (is_empty(box)) return Overlap::outside;
    const glm::dvec3 middle = centre(box) - cone.apex, half = half_extent(box);
    const double slack = rounding(cone.apex, box);
    const double along = glm::dot(middle, cone.axis);
    if (along + glm::dot(half, glm::abs(cone.axis)) < -slack) return Overlap::outside;
    // The plane through the apex that touches the cone on the box's side; its normal points into the cone.
    const double sine = std::sin(cone.half_angle_rad), cosine = std::cos(cone.half_angle_rad);
    const glm::dvec3 aside = middle - along * cone.axis;
    const double distance = glm::length(aside);
    const glm::dvec3 away = distance > 0.0 ? aside / distance : glm::dvec3(0.0);
    const glm::dvec3 normal = sine * cone.axis - cosine * away;
    const double depth = glm::dot(normal, middle);
    if (depth + glm::dot(half, glm::abs(normal)) < -slack) return Overlap::outside;
    return depth - glm::length(half) > slack ? Overlap::inside : Overlap::partial;
}

Overlap overlap_ball(const glm::dvec3& ball_centre, double radius, const Aabb& box) {
    if (is_empty(box)) return Overlap::outside;
    const double slack = rounding(ball_centre, box);
    if (distance(box, ball_centre) > radius + slack) return Overlap::outside;
    return farthest_distance(box, ball_centre) <= radius ? Overlap::inside : Overlap::partial;
}

}  // namespace gnomon::math
