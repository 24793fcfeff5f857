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

std::array<math::Plane, 4> frustum_planes(const glm::dvec3& light_ws_m, const LightFrustum& frustum) {
    const glm::dvec3 &u = frustum.axes[0], &v = frustum.axes[1], &back = frustum.axes[2];
    const auto through_light = [&](const glm::dvec3& normal) {
        return math::Plane{normal, -glm::dot(normal, light_ws_m)};
    };
    return {through_light(u + frustum.low.x * back), through_light(-u - frustum.high.x * back),
            through_light(v + frustum.low.y * back), through_light(-v - frustum.high.y * back)};
}

ReceiverHull directional_hull(const glm::dmat3& axes, std::span<const glm::dvec3> points_ws,
                              std::vector<glm::dvec2>& outlines, SetScratch& scratch) {
    ReceiverHull receiver_hull;
    receiver_hull.parallel = true;
    receiver_hull.origin_ws_m = points_ws.front();
    receiver_hull.axes = axes;
    receiver_hull.far_m = 0.0;
    receiver_hull.reach_m = std::numeric_limits<double>::infinity();
    scratch.points.clear();
    double size = 0.0;
    for (const glm::dvec3& p_ws : points_ws) {
        const glm::dvec3 p = (p_ws - receiver_hull.origin_ws_m) * axes;
        scratch.points.emplace_back(p.x, p.y);
        receiver_hull.far_m = std::max(receiver_hull.far_m, -p.z);
        size = std::max(size, largest_coordinate(p_ws));
    }
    receiver_hull.slack = math::kClippedRounding * size;
    receiver_hull.far_m += receiver_hull.slack;
    receiver_hull.outline = append_outline(receiver_hull.slack, outlines, scratch);
    return receiver_hull;
}

ReceiverHull frustum_hull(const glm::dvec3& light_ws_m, const LightFrustum& frustum,
                          std::span<const glm::dvec3> points_ws, std::vector<glm::dvec2>& outlines,
                          SetScratch& scratch) {
    ReceiverHull receiver_hull;
    receiver_hull.origin_ws_m = light_ws_m;
    receiver_hull.axes = frustum.axes;
    scratch.points.clear();
    double size = largest_coordinate(light_ws_m), slack = 0.0;
    for (const glm::dvec3& p_ws : points_ws) size = std::max(size, largest_coordinate(p_ws));
    for (const glm::dvec3& p_ws : points_ws) {
        const glm::dvec3 p = (p_ws - light_ws_m) * frustum.axes;
        receiver_hull.far_m = std::max(receiver_hull.far_m, -p.z);
        receiver_hull.reach_m = std::max(receiver_hull.reach_m, glm::length(p));
        // A point at the light itself has no direction: the clamp below handles NaN and infinity. No point is behind.
        const glm::dvec2 tangents = glm::dvec2(p) / -p.z;
        slack = std::max(slack,
                         -p.z > 0.0 ? math::kClippedRounding * size / -p.z : std::numeric_limits<double>::infinity());
        scratch.points.push_back(glm::clamp(tangents, frustum.low, frustum.high));
    }
    if (!(receiver_hull.far_m > math::kClippedRounding * size)) {
        receiver_hull.far_m = receiver_hull.reach_m = 0.0;
        return receiver_hull;
    }
    receiver_hull.far_m += math::kClippedRounding * size;
    receiver_hull.reach_m += math::kClippedRounding * size;
    const glm::dvec2 sides = frustum.high - frustum.low;
    if (slack < std::max(sides.x, sides.y)) {
        receiver_hull.slack = slack;
    } else {
        scratch.points.assign(
            {frustum.low, {frustum.high.x, frustum.low.y}, frustum.high, {frustum.low.x, frustum.high.y}});
    }
    receiver_hull.outline = append_outline(receiver_hull.slack, outlines, scratch);
    return receiver_hull;
}

}  // namespace gnomon::shadow
