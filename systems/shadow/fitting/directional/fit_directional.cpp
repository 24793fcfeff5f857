#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "systems/extract/volumes.h"
#include "systems/shadow/culling/inner_receivers.h"
#include "systems/shadow/fitting/directional/cascade_fit.h"
#include "systems/shadow/fitting/directional/cascade_slices.h"
#include "systems/shadow/fitting/directional/caster_depth_range.h"
#include "systems/shadow/fitting/directional/fit_lispsm.h"
#include "systems/shadow/fitting/directional/sdsm_splits.h"
#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/projection/depth_range_override.h"
#include "systems/shadow/projection/perspective_view.h"
#include "systems/shadow/projection/sun_viewpoint.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"

/// Directional light: cascades along the first camera's view, each an orthographic view placed by ShadowFit. Casters
/// nearer to the light than the depth range are flattened onto the near plane by depth clamping. They cast all the
/// same.
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
    const double size_px = input.request.map.resolution_px;
    return extent_m * size_px / (size_px - 2.0 * border_px(size_px, static_cast<double>(input.reach_texel)));
}

namespace {

/// Greatest lift of a receiver by the bias along the depth axis, in texels per texel of the filter's radius. It is
/// kSteepTangent of bias/automatic.glsl along both sides of a texel, 4 sqrt(2), and rounding. Steeper receivers move
/// along the normal, by less.
constexpr double kMostRise = 6.0;

double bias_room(const ShadowRequest& request, const glm::dvec2& extent_m) {
    const FilterSettings& filter = request.map.filtering;
    const auto reach_texel = static_cast<double>(needs_distances(filter) ? filter.reach_texel : filter.widest_texel);
    return kMostRise * reach_texel * std::max(extent_m.x, extent_m.y) / request.map.resolution_px;
}

}  // namespace

void place(const CascadeInput& input, const glm::dvec3& centre_ws, const glm::dvec2& extent_m, double depth_m,
           OrthographicBox& box) {
    const double largest_m = std::max({extent_m.x, extent_m.y, depth_m});
    const double slack_m = kDepthSlack * largest_m;
    box.anchor_ws_m = lattice_anchor(centre_ws, largest_m);
    const glm::dvec3 c = (centre_ws - box.anchor_ws_m) * box.axes;
    box.centre_m = glm::dvec2(c);
    box.half_extent_m = 0.5 * extent_m;
    box.near_m = -c.z - 0.5 * depth_m - slack_m - bias_room(input.light.request, extent_m);
    box.far_m = -c.z + 0.5 * depth_m + slack_m;
}

namespace {

/// Room before the receiver nearest to the light, in depth ranges, for filters that weigh distances. A caster flattened
/// onto that receiver would be lost. 16 bits resolve this gap (docs/explanation/prefiltered_maps.md).
constexpr double kRoomForCasters = 0.5;

/// Replaces the depth range by the request's, counted from the sun's eye.
void override_from_eye(const ShadowRequest& request, const SunViewpoint& eye, OrthographicBox& box) {
    const double eye_at_m = -glm::dot(eye.position_ws_m - box.anchor_ws_m, box.axes[2]);
    double near_m = box.near_m - eye_at_m, far_m = box.far_m - eye_at_m;
    override_range(request.projection, near_m, far_m);
    box.near_m = near_m + eye_at_m;
    box.far_m = far_m + eye_at_m;
    // Least range that does not vanish in the rounding of its own place.
    const double least_m = (std::abs(box.near_m) + std::abs(box.far_m)) * kLeastExtent;
    box.far_m = std::max(box.far_m, box.near_m + least_m);
}

/// Returns corners of the visible parts of receivers in the slice, and in `receivers` their count. Valid until the next
/// call.
std::span<const glm::dvec3> points_in(const CascadeSlice& slice, const ConsumerItem& consumer, const FitInput& input,
                                      std::uint32_t& receivers) {
    std::vector<glm::dvec3>& points_ws = input.scratch.points_ws;
    points_ws.clear();
    receivers = 0;
    if (!(slice.air_from_m < slice.holds_to_m)) return {};
    const math::Frustum frustum = consumer_frustum(consumer, slice.air_from_m, slice.holds_to_m);
    const SplitReceivers split =
        split_receivers(input.scene, input.receivers, {math::planes_of(frustum)}, input.scratch.split);
    points_ws.assign(split.corners_ws_m.begin(), split.corners_ws_m.end());
    receivers = static_cast<std::uint32_t>(split.inner.size());
    for (const std::uint32_t r : split.others)
        receivers += math::clip_box(frustum, input.scene.instances[r].bounds_ws, points_ws) > 0 ? 1 : 0;
    return points_ws;
}

/// Makes the view serve up to that distance and fade into no other.
void end_before(double distance_m, ShadowView& view) {
    if (view.cascade.seen_to_m > 0.0)
        view.cascade.seen_to_m = view.cascade.fades_from_m = view.cascade.fades_to_m = distance_m;
}

/// Returns whether a kept size of some cascade differs from the last frame's.
bool has_stepped(const FitInput& input) {
    for (std::size_t i = 0; i < kHistoryViews; ++i) {
        const ViewFitHistory &previous = input.previous.views[i], &next = input.next.views[i];
        if (previous.used && (next.extent_step != previous.extent_step || next.far_step != previous.far_step))
            return true;
    }
    return false;
}

void fit_cascades(const FitInput& input, const glm::dmat3& basis, const CascadeSlices& slices, Stepping stepping,
                  std::vector<ShadowView>& views) {
    const bool counts_from_eye = input.request.projection.near_m > 0.0 || input.request.projection.far_m > 0.0;
    const SunViewpoint eye = counts_from_eye
                                 ? sun_viewpoint(basis, input.receiver_points_ws, input.light.tuning.projection)
                                 : SunViewpoint{};
    const ConsumerItem& consumer = input.scene.consumers.front();
    // Several cameras share the cascades: the last one then contains what any of them sees.
    const bool alone = input.scene.consumers.size() == 1;
    const std::uint32_t count = input.request.map.view_count;
    const std::size_t before = views.size();
    for (ViewFitHistory& view : input.next.views) view.too_large = false;  // each cascade with receivers sets it again
    for (std::uint32_t i = 0; i < count; ++i) {
        const CascadeSlice& slice = slices[i];
        const bool first = views.size() == before, last = i + 1 == count, of_all = last && !alone;
        const bool whole = of_all || (last && first);
        auto receivers = static_cast<std::uint32_t>(input.receivers.size());
        const auto points_ws = whole ? input.receiver_points_ws : points_in(slice, consumer, input, receivers);
        OrthographicBox box;
        const CascadeInput cascade{input, basis, i, slice.air_from_m, slice.holds_to_m, of_all, points_ws, stepping};
        if (points_ws.empty() || !fit_cascade(cascade, box)) continue;
        // Maps with true distances contain the casters already.
        if (filter_row(input.request.map.filter).moments && !needs_distances(input.request.map.filtering))
            box.near_m -= kRoomForCasters * (box.far_m - box.near_m);
        if (counts_from_eye) override_from_eye(input.request, eye, box);
        // No receiver lies in the slices that were left out, nor in their fades.
        if (!first && views.back().layer + 1 < i) end_before(slice.holds_from_m, views.back());
        // Only the last cascade is warped. A map also serves what it contains beyond its slice, there with the coarsest
        // texels of a warp. The last one contains nothing of other slices.
        const auto warp = static_cast<double>(input.request.projection.warp);
        ShadowView view = warp > 0.0 ? warped_view(cascade, last ? warp : 0.0, box)
                                     : orthographic_view(box, input.request.map.resolution_px);
        view.layer = i;
        view.receivers = receivers;
        view.stays = input.light.tuning.cascades.fit != ShadowFit::tight;
        view.cascade.seen_from_m = alone ? slice.holds_from_m : 0.0;
        view.cascade.seen_to_m = alone && view.stays ? slice.serves_to_m : 0.0;
        view.cascade.fades_from_m = alone ? slice.fades_from_m : 0.0;
        view.cascade.fades_to_m = alone ? slice.serves_to_m : 0.0;
        if (view.plane.warp != glm::dvec2(0.0))
            state_error(consumer, points_ws,
                        static_cast<double>(input.reach_texel - input.request.map.filtering.still_texel), view);
        views.push_back(view);
    }
}

}  // namespace

bool fit_directional(const FitInput& input, std::vector<ShadowView>& views) {
    const glm::dmat3 basis = math::basis_from_back(input.light.rotation_ws[2]);
    if (input.request.projection.perspective_sun) return fit_perspective_sun(input, basis, views);
    const CascadeSlices slices = cascade_slices(input);
    const std::size_t before = views.size();
    const LightFitHistory& previous = input.previous;
    LightFitHistory& next = input.next;
    fit_cascades(input, basis, slices, previous.size.shrink_cooldown > 0 ? Stepping::larger : Stepping::as_needed,
                 views);
    const bool too_large =
        std::any_of(next.views.begin(), next.views.end(), [](const ViewFitHistory& view) { return view.too_large; });
    next.size.oversize_frames = too_large ? previous.size.oversize_frames + 1 : 0;
    next.size.shrink_cooldown = std::max(previous.size.shrink_cooldown, 1u) - 1;
    if (has_stepped(input) || next.size.oversize_frames >= kSpareFrames) {
        // Each change of a size shows. So sizes that would soon change do so in this frame, and none shrinks for
        // kSpareFrames frames.
        views.resize(before);
        next.views = previous.views;
        fit_cascades(input, basis, slices, Stepping::together, views);
        next.size.oversize_frames = 0;
        next.size.shrink_cooldown = kSpareFrames;
    }
    return views.size() > before;
}

}  // namespace gnomon::shadow
