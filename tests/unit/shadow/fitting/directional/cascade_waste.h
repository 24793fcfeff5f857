#pragma once
#include "systems/extract/volumes.h"
#include "systems/shadow/fitting/directional/min_area_rectangle.h"
#include "systems/shadow/frame/shadow_frame.h"
#include "systems/shadow/projection/perspective_view.h"

namespace gnomon::shadow {

/// Computes the share of a cascade's map, within its border, that its own slice leaves unused. The slice reaches to
/// where the next one serves alone, and counts as the smallest rectangle around its points.
inline double waste(const SceneSnapshot& scene, const ShadowFrame& frame, const ShadowView& view) {
    ConsumerItem slice = scene.consumers[0];
    slice.near_m = view.cascade.seen_from_m;
    const bool last = &view == &frame.fitted.views.back() || (&view + 1)->light != view.light;
    if (!last) slice.far_m = std::max(view.cascade.seen_to_m, (&view + 1)->cascade.seen_from_m);
    const math::Frustum frustum = consumer_frustum(slice);
    std::vector<glm::dvec3> points_ws;
    for (const std::uint32_t r : frame.fitted.sets_of(frame.sets, view.light).receivers())
        math::clip_box(frustum, scene.instances[r].bounds_ws, points_ws);
    std::vector<glm::dvec2> points, hull;
    for (const glm::dvec3& p : points_ws) {
        const glm::dvec3 q = p - view.pose.anchor_ws_m;
        points.emplace_back(glm::dot(q, view.pose.axis_u), glm::dot(q, view.pose.axis_v));
    }
    const Rectangle best = smallest_rectangle(points, hull);
    const glm::dvec2 size = best.max - best.min;
    const ShadowRequest& demand = frame.fitted.lights[view.light].request;
    const double size_px = demand.map.resolution_px;
    const double border =
        1.0 - 2.0 * border_px(size_px, static_cast<double>(demand.map.filtering.widest_texel)) / size_px;
    const glm::dvec2 map = 2.0 * view.plane.half_extent_m * border;
    return 1.0 - size.x * size.y / (map.x * map.y);
}

inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Computes the least step between two depths that a map of `quantum` (of standard, not reversed, depth) resolves at z,
/// metres.
inline double depth_step_m(double quantum, double near_m, double far_m, double z_m) {
    return quantum * z_m * z_m * (far_m - near_m) / (far_m * near_m);
}

}  // namespace gnomon::shadow
