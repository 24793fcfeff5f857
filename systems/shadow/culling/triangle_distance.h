#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace gnomon::shadow {

using Corners = std::array<glm::dvec3, 3>;  // corners of a triangle, relative to a lamp

/// Returns the distance from the origin to the nearest point of a segment.
inline double distance_to(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double length2 = glm::dot(along, along);
    const double at = length2 > 0.0 ? std::clamp(-glm::dot(a, along) / length2, 0.0, 1.0) : 0.0;
    return glm::length(a + at * along);
}

/// Returns the distance from the origin to the nearest point of a triangle. That is the foot of the perpendicular if it
/// lies inside, otherwise a point on an edge.
inline double distance_to(const Corners& c) {
    const double edges = std::min({distance_to(c[0], c[1]), distance_to(c[1], c[2]), distance_to(c[2], c[0])});
    const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    const double area = glm::length(normal);
    if (!(area > 0.0)) return edges;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 &from = c[i], &to = c[(i + 1) % 3];
        if (glm::dot(glm::cross(to - from, -from), normal) < 0.0) return edges;
    }
    return std::min(edges, std::abs(glm::dot(c[0], normal)) / area);
}

}  // namespace gnomon::shadow
