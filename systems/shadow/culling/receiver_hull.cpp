#include "systems/shadow/culling/receiver_hull.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/math/convex_polygon.h"

namespace gnomon::shadow {
namespace {

double largest_coordinate(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Appends a convex hull around scratch.points, which are known to within `slack`. Drops corners that rounding splits
/// or adds along a side: their edges have random directions, which would decide by chance which casters the hull
/// touches.
IndexRange append_outline(double slack, std::vector<glm::dvec2>& outlines, SetScratch& scratch) {
    math::convex_hull(scratch.points, scratch.polygon);
    math::drop_flat_corners(slack, scratch.polygon, scratch.clipped);
    widen(scratch.polygon, glm::dvec2(2.0 * slack), scratch);
    const IndexRange range{static_cast<std::uint32_t>(outlines.size()),
                           static_cast<std::uint32_t>(scratch.polygon.size())};
    outlines.insert(outlines.end(), scratch.polygon.begin(), scratch.polygon.end());
    return range;
}

}  // namespace

void widen(std::vector<glm::dvec2>& polygon, const glm::dvec2& by, SetScratch& scratch) {
    scratch.points.clear();
    for (const glm::dvec2& p : polygon)
        for (const glm::dvec2 corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)})
            scratch.points.push_back(p + by * corner);
    math::convex_hull(scratch.points, polygon);
}

std::array<math::Plane, 4> opening_planes(const glm::dvec3& light_ws_m, const LightOpening& opening) {
    const glm::dvec3 &u = opening.axes[0], &v = opening.axes[1], &back = opening.axes[2];
    const auto through_light = [&](const glm::dvec3& normal) {
        return math::Plane{normal, -glm::dot(normal, light_ws_m)};
    };
    return {through_light(u + opening.low.x * back), through_light(-u - opening.high.x * back),
            through_light(v + opening.low.y * back), through_light(-v - opening.high.y * back)};
}

Beam parallel_beam(const glm::dmat3& axes, std::span<const glm::dvec3> points_ws, std::vector<glm::dvec2>& outlines,
                   SetScratch& scratch) {
    Beam beam;
    beam.parallel = true;
    beam.origin_ws_m = points_ws.front();
    beam.axes = axes;
    beam.far_m = 0.0;
    beam.reach_m = std::numeric_limits<double>::infinity();
    scratch.points.clear();
    double size = 0.0;
    for (const glm::dvec3& p_ws : points_ws) {
        const glm::dvec3 p = (p_ws - beam.origin_ws_m) * axes;
        scratch.points.emplace_back(p.x, p.y);
        beam.far_m = std::max(beam.far_m, -p.z);
        size = std::max(size, largest_coordinate(p_ws));
    }
    beam.slack = math::kClippedRounding * size;
    beam.far_m += beam.slack;
    beam.outline = append_outline(beam.slack, outlines, scratch);
    return beam;
}

Beam opening_beam(const glm::dvec3& light_ws_m, const LightOpening& opening, std::span<const glm::dvec3> points_ws,
                  std::vector<glm::dvec2>& outlines, SetScratch& scratch) {
    Beam beam;
    beam.origin_ws_m = light_ws_m;
    beam.axes = opening.axes;
    scratch.points.clear();
    double size = largest_coordinate(light_ws_m), slack = 0.0;
    for (const glm::dvec3& p_ws : points_ws) size = std::max(size, largest_coordinate(p_ws));
    for (const glm::dvec3& p_ws : points_ws) {
        const glm::dvec3 p = (p_ws - light_ws_m) * opening.axes;
        beam.far_m = std::max(beam.far_m, -p.z);
        beam.reach_m = std::max(beam.reach_m, glm::length(p));
        // A point at the light itself has no direction: the clamp below handles NaN and infinity. No point is behind.
        const glm::dvec2 tangents = glm::dvec2(p) / -p.z;
        slack = std::max(slack,
                         -p.z > 0.0 ? math::kClippedRounding * size / -p.z : std::numeric_limits<double>::infinity());
        scratch.points.push_back(glm::clamp(tangents, opening.low, opening.high));
    }
    if (!(beam.far_m > math::kClippedRounding * size)) {
        beam.far_m = beam.reach_m = 0.0;
        return beam;
    }
    beam.far_m += math::kClippedRounding * size;
    beam.reach_m += math::kClippedRounding * size;
    const glm::dvec2 sides = opening.high - opening.low;
    if (slack < std::max(sides.x, sides.y)) {
        beam.slack = slack;
    } else {
        scratch.points.assign(
            {opening.low, {opening.high.x, opening.low.y}, opening.high, {opening.low.x, opening.high.y}});
    }
    beam.outline = append_outline(beam.slack, outlines, scratch);
    return beam;
}

}  // namespace gnomon::shadow
