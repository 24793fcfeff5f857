#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/math/frustum.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/kinds/orthographic_view.h"
#include "systems/shadow/kinds/perspective_view.h"
#include "systems/shadow/kinds/rectangle.h"
#include "systems/shadow/kinds/sun_eye.h"
#include "systems/shadow/light_kinds.h"
#include "systems/shadow/range_override.h"

/// Directional light: cascades along the first consumer's view, each an orthographic view around the smallest rotated
/// rectangle of the receivers seen in its slice, as the light sees them. Depth runs from the receiver nearest the
/// light to the farthest; casters nearer still are flattened onto the near plane by depth clamping and cast all the
/// same.
namespace gnomon::shadow {
namespace {

/// A flat set of receivers gets at least this share of the largest extent, so that nothing divides by zero.
constexpr double kLeastExtent = 1.0 / (1 << 20);
/// Receivers at the ends of the depth range stay clear of the clamp by this share of the range.
constexpr double kDepthSlack = 1.0 / (1 << 10);

/// A lattice point near `centre_ws`, the same for all fits of about this size: fixed to the world while cameras move.
glm::dvec3 lattice_anchor(const glm::dvec3& centre_ws, double extent_m) {
    const double cell_m = std::exp2(std::ceil(std::log2(extent_m)) + 2.0);
    return glm::round(centre_ws / cell_m) * cell_m;
}

struct DepthRange {
    double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
    void include(double value) {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
    }
};

/// Share of logarithmic against uniform splits (Zhang et al. 2006, "practical split scheme").
constexpr double kLogarithmicShare = 0.7;
/// The nearest split starts no nearer than this share of the farthest receiver: a camera inside a receiver's
/// box sees it from distance 0 as far as bounds can tell, and a logarithm needs a start.
constexpr double kNearestShare = 1.0 / 1024;

/// Where cascade i of n ends, as distance along the view.
double split_m(const DepthRange& seen, std::uint32_t i, std::uint32_t n, bool perspective) {
    const double share = static_cast<double>(i) / static_cast<double>(n);
    const double uniform = seen.lowest + (seen.highest - seen.lowest) * share;
    if (!perspective) return uniform;
    const double start = std::max(seen.lowest, seen.highest * kNearestShare);
    return kLogarithmicShare * start * std::pow(seen.highest / start, share) + (1.0 - kLogarithmicShare) * uniform;
}

/// The depth range that the demand asks for, counted from the sun's eye.
void override_from_eye(const ShadowDemand& demand, const SunEye& eye, OrthographicBox& box) {
    const double eye_at_m = -glm::dot(eye.position_ws_m - box.anchor_ws_m, box.axes[2]);
    double near_m = box.near_m - eye_at_m, far_m = box.far_m - eye_at_m;
    override_range(demand, near_m, far_m);
    box.near_m = near_m + eye_at_m;
    box.far_m = far_m + eye_at_m;
    // A range that its own place rounds away.
    const double least_m = (std::abs(box.near_m) + std::abs(box.far_m)) * kLeastExtent;
    box.far_m = std::max(box.far_m, box.near_m + least_m);
}

/// One perspective view from the sun's eye.
bool fit_perspective_sun(const FitInput& input, const glm::dmat3& basis, std::vector<ShadowView>& views) {
    const SunEye eye = sun_eye(basis, input.receiver_points_ws, input.light.shadow);
    DepthRange depth;
    for (const glm::dvec3& p : input.receiver_points_ws) depth.include(glm::dot(eye.position_ws_m - p, basis[2]));
    double nearest = depth.lowest;
    for (const std::uint32_t i : input.casters) {
        const math::Aabb& box = input.scene.instances[i].bounds_ws;
        const double reach = glm::dot(math::half_extent(box), glm::abs(basis[2]));
        nearest = std::min(nearest, glm::dot(eye.position_ws_m - math::centre(box), basis[2]) - reach);
    }
    const PerspectiveRange range = overridden(input.demand, perspective_range(nearest, depth.highest));
    if (!(range.near_m < range.far_m) || !std::isfinite(range.far_m)) return false;
    const double tan_half = std::tan(0.5 * static_cast<double>(input.light.shadow.eye_angle_rad));
    views.push_back(perspective_view(eye.position_ws_m, basis, tan_half, range, input.demand.resolution_px,
                                     static_cast<double>(input.reach_texel)));
    return true;
}

/// One orthographic view around `points_ws`. False if they span nothing finite.
bool fit_rectangle(const FitInput& input, const glm::dmat3& basis, const SunEye* eye,
                   std::span<const glm::dvec3> points_ws, ShadowView& view) {
    FitScratch& scratch = input.scratch;
    scratch.points.clear();
    DepthRange depth;
    const glm::dvec3 origin_ws = points_ws.front();
    for (const glm::dvec3& p_ws : points_ws) {
        const glm::dvec3 p = (p_ws - origin_ws) * basis;
        scratch.points.emplace_back(p.x, p.y);
        depth.include(p.z);
    }
    const Rectangle rectangle = smallest_rectangle(scratch.points, scratch.hull);
    const glm::dvec2 extent = rectangle.max - rectangle.min;
    const double largest = std::max({extent.x, extent.y, depth.highest - depth.lowest});
    if (!(largest > 0.0) || !std::isfinite(largest)) return false;

    OrthographicBox box;
    box.axes[0] = basis[0] * rectangle.axis_u.x + basis[1] * rectangle.axis_u.y;
    box.axes[1] = basis[1] * rectangle.axis_u.x - basis[0] * rectangle.axis_u.y;
    box.axes[2] = basis[2];

    const double size_px = input.demand.resolution_px;
    const double margin_px = std::ceil(static_cast<double>(input.reach_texel)) + 1.0;  // filter footprint, and snapping
    box.half_extent_m =
        0.5 * glm::max(extent, glm::dvec2(largest * kLeastExtent)) * (size_px / (size_px - 2.0 * margin_px));
    const double range_m = std::max(depth.highest - depth.lowest, largest * kLeastExtent);
    const double slack_m = range_m * kDepthSlack;

    const glm::dvec2 middle = 0.5 * (rectangle.min + rectangle.max);
    const glm::dvec3 centre_ws = origin_ws + box.axes[0] * middle.x + box.axes[1] * middle.y +
                                 box.axes[2] * (0.5 * (depth.lowest + depth.highest));
    box.anchor_ws_m = lattice_anchor(centre_ws, largest);
    const glm::dvec3 c = (centre_ws - box.anchor_ws_m) * box.axes;
    box.centre_m = glm::dvec2(c);
    box.near_m = -c.z - 0.5 * range_m - slack_m;
    box.far_m = -c.z + 0.5 * range_m + slack_m;
    if (eye) override_from_eye(input.demand, *eye, box);
    view = orthographic_view(box, size_px);
    return true;
}

/// The slice of what the consumer sees between two distances along its view.
ConsumerItem slice(ConsumerItem consumer, double from_m, double to_m) {
    consumer.near_m = from_m;
    consumer.far_m = to_m;
    return consumer;
}

}  // namespace

bool fit_directional(const FitInput& input, std::vector<ShadowView>& views) {
    const glm::dmat3 basis = math::basis_from_back(input.light.rotation_ws[2]);
    if (input.demand.perspective_sun) return fit_perspective_sun(input, basis, views);
    const bool counts_from_eye = input.demand.near_m > 0.0 || input.demand.far_m > 0.0;
    const SunEye eye = counts_from_eye ? sun_eye(basis, input.receiver_points_ws, input.light.shadow) : SunEye{};
    const ConsumerItem& consumer = input.scene.consumers.front();
    const bool perspective = consumer.projection == CameraProjection::perspective;
    DepthRange seen;
    for (const glm::dvec3& p : input.receiver_points_ws)
        seen.include(-glm::dot(p - consumer.position_ws_m, consumer.rotation_ws[2]));
    seen.lowest = std::max(seen.lowest, consumer.near_m);
    seen.highest = std::max(seen.highest, seen.lowest);
    // Several consumers share the cascades: the last one then holds whatever any of them sees.
    const bool alone = input.scene.consumers.size() == 1;

    std::vector<glm::dvec3>& points_ws = input.scratch.points_ws;
    std::uint32_t layer = 0;
    double from_m = seen.lowest;
    for (std::uint32_t i = 1; i <= input.demand.view_count; ++i) {
        const bool last = i == input.demand.view_count;
        const double to_m = last ? seen.highest : split_m(seen, i, input.demand.view_count, perspective);
        points_ws.clear();
        if (last && (!alone || layer == 0)) {
            points_ws.assign(input.receiver_points_ws.begin(), input.receiver_points_ws.end());
        } else if (from_m < to_m) {
            const math::Frustum frustum = consumer_frustum(slice(consumer, from_m, to_m));
            for (const std::uint32_t r : input.receivers)
                math::clip_box(frustum, input.scene.instances[r].bounds_ws, points_ws);
        }
        ShadowView view;
        if (!points_ws.empty() && fit_rectangle(input, basis, counts_from_eye ? &eye : nullptr, points_ws, view)) {
            view.layer = layer;
            view.seen_from_m = alone ? from_m : 0.0;
            views.push_back(view);
            ++layer;
        }
        from_m = to_m;
    }
    return layer > 0;
}

}  // namespace gnomon::shadow
