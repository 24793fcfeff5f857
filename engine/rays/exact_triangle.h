#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

/// Ray against triangle, in double. Decides all cases in which float is uncertain.
namespace gnomon::rays {

/// Corners of a triangle relative to the ray's origin.
struct ExactTriangle {
    glm::dvec3 a{0.0}, b{0.0}, c{0.0};
};

/// Hit at `t` times the ray's direction, with the barycentric weights of the corners.
struct ExactHit {
    double t = 0.0;
    glm::dvec3 weights{0.0};
};

/// Computes on which side of the edge pq the ray passes, in Plücker coordinates. Antisymmetric in p and q to the last
/// bit, so that a ray never slips between two triangles with a common edge. Each product must be rounded separately
/// (-ffp-contract=off). The error is below 16 units of double times |q - p| |p + q| |along|.
inline double side_of_edge(const glm::dvec3& along, const glm::dvec3& p, const glm::dvec3& q) {
    return glm::dot(along, glm::cross(q - p, p + q));
}

/// Returns true if the ray's line hits the triangle; `hit` is then set. Both faces count, edges and corners belong to
/// the triangle, t has any sign. A line in the triangle's plane misses, as does NaN.
inline bool meets(const glm::dvec3& along, const ExactTriangle& triangle, ExactHit& hit) {
    const double a = side_of_edge(along, triangle.b, triangle.c);
    const double b = side_of_edge(along, triangle.c, triangle.a);
    const double c = side_of_edge(along, triangle.a, triangle.b);
    if ((a < 0.0 || b < 0.0 || c < 0.0) && (a > 0.0 || b > 0.0 || c > 0.0)) return false;
    const double sum = a + b + c;
    const glm::dvec3 normal = glm::cross(triangle.b - triangle.a, triangle.c - triangle.a);
    const double slope = glm::dot(normal, along);
    if (!(std::abs(sum) > 0.0) || !(std::abs(slope) > 0.0)) return false;
    hit = {glm::dot(normal, triangle.a) / slope, glm::dvec3(a, b, c) / sum};
    return true;
}

/// Returns true if the ray starts on the triangle's plane, up to a rounding of `error` in the corners. A line crosses a
/// plane once, so that such a triangle cannot block the ray elsewhere.
inline bool begins_on_plane(const ExactTriangle& triangle, double error) {
    const glm::dvec3 normal = glm::cross(triangle.b - triangle.a, triangle.c - triangle.a);
    return std::abs(glm::dot(normal, triangle.a)) <= error * glm::length(normal);
}

/// Returns true if the ray ends on the triangle's plane. `end` is relative to the ray's origin; false if it is not
/// finite.
inline bool ends_on_plane(const glm::dvec3& end, const ExactTriangle& triangle, double error) {
    return begins_on_plane({triangle.a - end, triangle.b - end, triangle.c - end}, error);
}

/// Returns true if the ray starts on the side from which the corners run counter-clockwise.
inline bool begins_before(const ExactTriangle& triangle) {
    return glm::dot(glm::cross(triangle.b - triangle.a, triangle.c - triangle.a), triangle.a) < 0.0;
}

}  // namespace gnomon::rays
