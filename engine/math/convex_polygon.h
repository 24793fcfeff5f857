#pragma once
#include <glm/vec2.hpp>
#include <span>
#include <vector>

/// Convex polygons in the plane: corners counter-clockwise, the leftmost first (the lowest of several). One or two
/// points are polygons, too.
namespace gnomon::math {

/// Computes the corners of the smallest convex polygon around `points`, none on a line between two others (Andrew
/// 1979). Points inside the octagon of the eight outermost ones are dropped first (Akl & Toussaint 1978). `points` is
/// reordered. Linear, except for sorting the few points that remain. Empty in, empty out. Points with NaN give no
/// useful result.
void convex_hull(std::span<glm::dvec2> points, std::vector<glm::dvec2>& hull);

/// Drops corners within `tolerance` of a line between two corners that stay. Such corners appear where rounding splits
/// a corner or adds one along a side. Each side moves inward by at most `tolerance`. The result starts at the corner
/// farthest from the first one. `scratch` is overwritten.
void drop_flat_corners(double tolerance, std::vector<glm::dvec2>& polygon, std::vector<glm::dvec2>& scratch);

/// Cuts off the part with dot(normal, p) + offset < 0 (Sutherland & Hodgman 1974). `scratch` is overwritten.
void clip_polygon(const glm::dvec2& normal, double offset, std::vector<glm::dvec2>& polygon,
                  std::vector<glm::dvec2>& scratch);

}  // namespace gnomon::math
