#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

/// Whether a ray meets a triangle, in double: what decides wherever float is not sure.
namespace gnomon::rays {

/// A triangle's corners relative to where the ray begins.
struct ExactTriangle {
    glm::dvec3 a{0.0}, b{0.0}, c{0.0};
};

/// At `t` times the ray's direction, where the corners have these weights.
struct ExactHit {
    double t = 0.0;
    glm::dvec3 weights{0.0};
};

/// On which side of the edge the ray passes, in Plücker coordinates: antisymmetric in p and q to the last bit, so that
/// two triangles with a common edge never both lose a ray that crosses it. Products must be rounded one by one
/// (-ffp-contract=off). Off by less than 16 units of double times |q - p| |p + q| |along|.
inline double side_of_edge(const glm::dvec3& along, const glm::dvec3& p, const glm::dvec3& q) {
    return glm::dot(along, glm::cross(q - p, p + q));
}

/// False if the ray's line misses the triangle or runs in its plane; NaN misses. Both faces are met, edges and corners
/// belong to the triangle. Any sign of t.
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

/// Whether the ray begins on the triangle's plane, but for a rounding of `error` in the corners. A line meets a plane
/// once: such a triangle is where the ray is, it does not stand in its way.
inline bool begins_on_plane(const ExactTriangle& triangle, double error) {
    const glm::dvec3 normal = glm::cross(triangle.b - triangle.a, triangle.c - triangle.a);
    return std::abs(glm::dot(normal, triangle.a)) <= error * glm::length(normal);
}

/// The same of where it ends, relative to where it begins. Not finite: it has no end.
inline bool ends_on_plane(const glm::dvec3& end, const ExactTriangle& triangle, double error) {
    return begins_on_plane({triangle.a - end, triangle.b - end, triangle.c - end}, error);
}

/// Whether it begins on the side from where the corners run counter-clockwise.
inline bool begins_before(const ExactTriangle& triangle) {
    return glm::dot(glm::cross(triangle.b - triangle.a, triangle.c - triangle.a), triangle.a) < 0.0;
}

}  // namespace gnomon::rays
