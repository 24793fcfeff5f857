#include "systems/shadow/fitting/directional/min_area_rectangle.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/math/convex_polygon.h"

namespace gnomon::shadow {
namespace {

Rectangle along(const glm::dvec2& axis_u, std::span<const glm::dvec2> points) {
    Rectangle r;
    r.axis_u = axis_u;
    r.min = glm::dvec2(std::numeric_limits<double>::infinity());
    r.max = -r.min;
    for (const glm::dvec2& p : points) {
        const glm::dvec2 q(glm::dot(axis_u, p), axis_u.x * p.y - axis_u.y * p.x);
        r.min = glm::min(r.min, q);
        r.max = glm::max(r.max, q);
    }
    return r;
}

/// Ratio below which an area counts as smaller. Any triangle has sides of equal area, as have opposite sides. The first
/// one in the hull's order stays, so that rounding does not alternate between them.
constexpr double kClearlyLess = 1.0 - 1.0 / (1 << 20);

/// Least length of an edge that decides, in slacks. Two points that differ only by rounding are up to 2 √2 apart, with
/// an edge of any direction between.
constexpr double kShortestEdge = 4.0;

}  // namespace

Rectangle smallest_rectangle(std::span<glm::dvec2> points, std::vector<glm::dvec2>& hull_scratch, double slack) {
    if (points.empty()) return along({1.0, 0.0}, {});
    math::convex_hull(points, hull_scratch);
    Rectangle best = along({1.0, 0.0}, hull_scratch);
    double best_area = (best.max.x - best.min.x) * (best.max.y - best.min.y);
    for (std::size_t i = 0; i < hull_scratch.size(); ++i) {
        const glm::dvec2 edge = hull_scratch[(i + 1) % hull_scratch.size()] - hull_scratch[i];
        const double size = std::hypot(edge.x, edge.y);
        if (!(size > kShortestEdge * slack)) continue;
        const Rectangle r = along(edge / size, hull_scratch);
        const double area = (r.max.x - r.min.x) * (r.max.y - r.min.y);
        if (area < best_area * kClearlyLess) {
            best = r;
            best_area = area;
        }
    }
    return best;
}

}  // namespace gnomon::shadow
