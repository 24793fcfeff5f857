#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "systems/extract/volumes.h"
#include "systems/shadow/kinds/cascade_fit.h"
#include "systems/shadow/kinds/held_fit.h"
#include "systems/shadow/kinds/perspective_view.h"
#include "systems/shadow/kinds/splits.h"
#include "systems/shadow/kinds/steps.h"
#include "systems/shadow/kinds/sun_eye.h"
#include "systems/shadow/range_override.h"

/// Directional light: cascades along the first consumer's view, each an orthographic view that LightShadow::fit places.
/// Casters nearer to the light than the depth range are flattened onto the near plane by depth clamping and cast all
/// the same.
namespace gnomon::shadow {

CascadeFit cascade_fit(ShadowFit mode) {
    switch (mode) {
        case ShadowFit::stable:
            return fit_stable;
        case ShadowFit::quantised:
            return fit_quantised;
        case ShadowFit::tight:
            break;
    }
    return fit_tight;
}

glm::dvec3 lattice_anchor(const glm::dvec3& centre_ws, double extent_m) {
    const double cell_m = std::exp2(std::ceil(std::log2(extent_m)) + 2.0);
    return glm::round(centre_ws / cell_m) * cell_m;
}

double with_border(double extent_m, const FitInput& input) {
    const double size_px = input.demand.resolution_px;
    return extent_m * size_px / (size_px - 2.0 * border_px(size_px, static_cast<double>(input.reach_texel)));
}

void place(const glm::dvec3& centre_ws, const glm::dvec2& extent_m, double depth_m, OrthographicBox& box) {
    box.anchor_ws_m = lattice_anchor(centre_ws, std::max({extent_m.x, extent_m.y, depth_m}));
    const glm::dvec3 c = (centre_ws - box.anchor_ws_m) * box.axes;
    box.centre_m = glm::dvec2(c);
    box.half_extent_m = 0.5 * extent_m;
    box.near_m = -c.z - 0.5 * depth_m;
    box.far_m = -c.z + 0.5 * depth_m;
}

namespace {

/// The depths that cascades share are held while what is seen fills at least a quarter of them. A stable fit's depend
/// on the camera's place alone and need less patience (kHoldSteps).
constexpr int kHoldDepthSteps = 8;

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

double view_distance(const ConsumerItem& consumer, const glm::dvec3& p_ws) {
    return -glm::dot(p_ws - consumer.position_ws_m, consumer.rotation_ws[2]);
}

/// Between which view distances the cascades lie.
DepthSpan whole_span(const FitInput& input, const ConsumerItem& consumer) {
    DepthSpan span{std::numeric_limits<double>::infinity(), 0.0};
    if (input.light.shadow.fit == ShadowFit::stable) {
        // Turning the camera must change nothing: what counts is how far a receiver is, in any direction.
        for (const InstanceItem& item : input.scene.instances)
            if (item.visible && item.receives)
                span.highest = std::max(span.highest, math::farthest_distance(item.bounds_ws, consumer.position_ws_m));
        span.lowest = consumer.near_m;
    } else {
        for (const glm::dvec3& p : input.receiver_points_ws) {
            const double distance_m = view_distance(consumer, p);
            span.lowest = std::min(span.lowest, distance_m);
            span.highest = std::max(span.highest, distance_m);
        }
    }
    const double least_m = std::max(consumer.near_m, span.highest * kLeastExtent);
    span.lowest = std::max(span.lowest, least_m);
    span.highest = std::max(span.highest, span.lowest);
    if (input.light.shadow.fit == ShadowFit::tight || !std::isfinite(span.highest)) return span;

    const HeldDepths& held = input.held.depths;
    HeldDepths& next = input.next.depths;
    const int patience = input.light.shadow.fit == ShadowFit::stable ? kHoldSteps : kHoldDepthSteps;
    next.far_step = hold_above(span.highest, held.used, held.far_step, patience);
    next.near_step = hold_below(span.lowest, held.used, held.near_step, patience);
    next.used = true;
    return {step_size(next.near_step), step_size(next.far_step)};
}

/// The slice of what the consumer sees between two distances along its view.
ConsumerItem slice(ConsumerItem consumer, double from_m, double to_m) {
    consumer.near_m = from_m;
    consumer.far_m = to_m;
    return consumer;
}

CascadeEnds split(const FitInput& input, const ConsumerItem& consumer) {
    std::vector<DepthSpan>& receivers = input.scratch.depths;
    receivers.clear();
    if (input.light.shadow.splits == CascadeSplits::seen)
        for (const std::uint32_t r : input.receivers) {
            const math::Aabb& box = input.scene.instances[r].bounds_ws;
            const double middle = view_distance(consumer, math::centre(box));
            const double reach = glm::dot(math::half_extent(box), glm::abs(consumer.rotation_ws[2]));
            receivers.push_back({middle - reach, middle + reach});
        }
    return cascade_ends(input.light.shadow, input.demand.view_count, whole_span(input, consumer),
                        consumer.projection == CameraProjection::perspective, receivers);
}

}  // namespace

bool fit_directional(const FitInput& input, std::vector<ShadowView>& views) {
    const glm::dmat3 basis = math::basis_from_back(input.light.rotation_ws[2]);
    if (input.demand.perspective_sun) return fit_perspective_sun(input, basis, views);
    const bool counts_from_eye = input.demand.near_m > 0.0 || input.demand.far_m > 0.0;
    const SunEye eye = counts_from_eye ? sun_eye(basis, input.receiver_points_ws, input.light.shadow) : SunEye{};
    const ConsumerItem& consumer = input.scene.consumers.front();
    const CascadeEnds ends = split(input, consumer);
    // Several consumers share the cascades: the last one then holds whatever any of them sees.
    const bool alone = input.scene.consumers.size() == 1;
    const std::uint32_t count = input.demand.view_count;
    const auto blend = static_cast<double>(input.demand.cascade_blend);
    const std::size_t before = views.size();
    std::vector<glm::dvec3>& points_ws = input.scratch.points_ws;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool last = i + 1 == count, of_all = last && !alone;
        // The cascade before fades into this one over its last part.
        const bool first = views.size() == before;
        const double fading_m = first ? 0.0 : blend * (ends[i] - ends[i - 1]);
        const double from_m = ends[i] - fading_m, to_m = ends[i + 1];
        points_ws.clear();
        if (of_all || (last && first)) {
            points_ws.assign(input.receiver_points_ws.begin(), input.receiver_points_ws.end());
        } else if (from_m < to_m) {
            const math::Frustum frustum = consumer_frustum(slice(consumer, from_m, to_m));
            for (const std::uint32_t r : input.receivers)
                math::clip_box(frustum, input.scene.instances[r].bounds_ws, points_ws);
        }
        OrthographicBox box;
        const CascadeInput cascade{input, basis, i, from_m, to_m, of_all, points_ws};
        if (points_ws.empty() || !cascade_fit(input.light.shadow.fit)(cascade, box)) continue;
        if (counts_from_eye) override_from_eye(input.demand, eye, box);
        // Slices without receivers have no view: the one before serves up to here.
        if (!first && views.back().seen_to_m > 0.0) views.back().seen_to_m = ends[i];
        ShadowView view = orthographic_view(box, input.demand.resolution_px);
        view.layer = i;
        view.held = input.light.shadow.fit != ShadowFit::tight;
        view.seen_from_m = alone ? from_m : 0.0;
        view.seen_to_m = alone && view.held ? to_m : 0.0;
        views.push_back(view);
    }
    return views.size() > before;
}

}  // namespace gnomon::shadow
