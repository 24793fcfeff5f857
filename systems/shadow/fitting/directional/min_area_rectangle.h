#pragma once
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// A rotated rectangle: axis_u is unit, axis_v = (-axis_u.y, axis_u.x); min and max along them.
struct Rectangle {
    glm::dvec2 axis_u{1.0, 0.0};
    glm::dvec2 min{0.0}, max{0.0};
};

/// Smallest-area rectangle that holds all points: one side lies on an edge of their convex hull
/// (Freeman & Shapira 1975), up to 2^-20 of the area. Total: one point or a line give a rectangle of zero area.
/// `slack`: by how much rounding may have moved a point; edges that it may have made decide nothing.
/// `points` is reordered. An empty span gives an inverted rectangle (min > max).
Rectangle smallest_rectangle(std::span<glm::dvec2> points, std::vector<glm::dvec2>& hull_scratch, double slack = 0.0);

}  // namespace gnomon::shadow
