#pragma once
#include <glm/vec2.hpp>
#include <span>
#include <vector>

/// Convex polygons in the plane: corners against the clock's hand, the first the leftmost (the lowest of several).
/// One point or two are polygons, too.
namespace gnomon::math {

/// Corners of the smallest convex polygon around `points`, none on a line between two others (Andrew 1979, after
/// leaving out what lies inside the octagon of the eight outermost points, Akl & Toussaint 1978). `points` is
/// reordered. Linear but for the few points that remain. Empty in, empty out. Points with NaN give no useful result.
void convex_hull(std::span<glm::dvec2> points, std::vector<glm::dvec2>& hull);

/// Leaves out the corners that lie no farther than `tolerance` from a line between two that stay, so that corners which
/// rounding of that size splits, or adds along a side, do not count. The polygon loses no more than `tolerance` to any
/// side. It starts from the corner that is farthest from the first one. `scratch` is overwritten.
void drop_flat_corners(double tolerance, std::vector<glm::dvec2>& polygon, std::vector<glm::dvec2>& scratch);

/// Cuts off what has dot(normal, p) + offset < 0 (Sutherland & Hodgman 1974). `scratch` is overwritten.
void clip_polygon(const glm::dvec2& normal, double offset, std::vector<glm::dvec2>& polygon,
                  std::vector<glm::dvec2>& scratch);

}  // namespace gnomon::math
