#pragma once
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// Rotated rectangle: axis_u is unit, axis_v = (-axis_u.y, axis_u.x); min and max along them.
struct Rectangle {
    glm::dvec2 axis_u{1.0, 0.0};
    glm::dvec2 min{0.0}, max{0.0};
};

/// Returns the smallest-area rectangle that contains all points. One side lies on an edge of their convex hull (Freeman
/// & Shapira 1975), up to 2^-20 of the area.
///
/// `slack`: how far rounding may have moved a point. Edges that it may have made decide nothing.
/// `points` is reordered. One point or a line give zero area; an empty span gives an inverted rectangle (min > max).
Rectangle smallest_rectangle(std::span<glm::dvec2> points, std::vector<glm::dvec2>& hull_scratch, double slack = 0.0);

}  // namespace gnomon::shadow
