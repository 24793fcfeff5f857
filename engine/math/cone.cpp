#include "engine/math/cone.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace gnomon::math {
namespace {

/// Bounds the rounding of differences between coordinates of this size: the same bound as in frustum.cpp.
double rounding(const glm::dvec3& p, const Aabb& box) {
    const glm::dvec3 largest = glm::max(glm::abs(p), glm::max(glm::abs(box.min), glm::abs(box.max)));
    return 0x1p-48 * (largest.x + largest.y + largest.z);
}

}  // namespace

std::array<Plane, kConeSides + 1> planes_around(const Cone& cone) {
    const double sine = std::sin(cone.half_angle_rad), cosine = std::cos(cone.half_angle_rad);
    const glm::dmat3 basis = basis_from_back(cone.axis);
    const auto through_apex = [&](const glm::dvec3& normal) { return Plane{normal, -glm::dot(normal, cone.apex)}; };
    std::array<Plane, kConeSides + 1> planes;
    for (std::size_t i = 0; i < kConeSides; ++i) {
        const double turn_rad = 2.0 * std::numbers::pi * static_cast<double>(i) / kConeSides;
        const glm::dvec3 away = basis[0] * std::cos(turn_rad) + basis[1] * std::sin(turn_rad);
        planes[i] = through_apex(sine * cone.axis - cosine * away);
    }
    planes[kConeSides] = through_apex(cone.axis);
    return planes;
}

std::array<glm::dvec3, kConeSides> edges_around(const Cone& cone) {
    const glm::dmat3 basis = basis_from_back(cone.axis);
    const double aside = std::tan(cone.half_angle_rad) / std::cos(std::numbers::pi / kConeSides);
    std::array<glm::dvec3, kConeSides> edges;
    for (std::size_t i = 0; i < kConeSides; ++i) {
        const double turn_rad = 2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / kConeSides;
        edges[i] = cone.axis + aside * (basis[0] * std::cos(turn_rad) + basis[1] * std::sin(turn_rad));
    }
    return edges;
}

Overlap overlap_ball(const glm::dvec3& ball_centre, double radius, const Aabb& box) {
    if (is_empty(box)) return Overlap::outside;
    const double slack = rounding(ball_centre, box);
    if (distance(box, ball_centre) > radius + slack) return Overlap::outside;
    return farthest_distance(box, ball_centre) <= radius ? Overlap::inside : Overlap::partial;
}

}  // namespace gnomon::math
