#include "systems/shadow/fit.h"

#include <algorithm>
#include <cmath>

#include "systems/shadow/contract.h"
#include "systems/shadow/demand.h"
#include "systems/shadow/depth_format.h"
#include "systems/shadow/light_kinds.h"
#include "systems/shadow/light_time.h"
#include "systems/shadow/predicted_error.h"
#include "systems/shadow/view_casters.h"

namespace gnomon::shadow {
namespace {

/// How often a light is fitted anew for maps of another size: for what its present ones tell, and once more because a
/// filter's border is a larger share of a smaller map.
constexpr int kMostSizes = 2;

/// Edge of the smallest texel in metres across the light.
double finest_texel_m(const ShadowView& view) {
    const double texel = std::min(view.texel_u, view.texel_v);
    return view.projection == ViewProjection::orthographic ? texel : texel * view.near_m;
}

/// What the view's texels mean on the screen of the consumer that sees them largest. A warped map serves its own slice
/// alone: its fit has said it.
void state_errors(const SceneSnapshot& scene, std::span<const glm::dvec3> points_ws, double reach_texel,
                  ShadowView& view) {
    for (std::uint32_t c = 0; c < scene.consumers.size(); ++c)
        if (view.warp == glm::dvec2(0.0)) state_error(scene.consumers[c], points_ws, reach_texel, view);
}

/// Whose receivers lie in it: of a sun's cascades those of all, since each may reach into another's slice.
void state_receivers(const LightItem& light, const PotentialSets& sets, const ShadowFrame& frame, ShadowView& view) {
    const bool sun = light.kind == LightKind::directional;
    const Beam& beam = frame.beams[sets.beams.first + (sun ? 0 : view.layer)];
    view.consumer_mask = beam.consumers;
    if (view.receivers == 0) view.receivers = beam.receivers;
}

/// Depths that differ by less are one, at the farthest receiver: 0 of floats, whose steps are a share of the distance.
double depth_step_m(const ShadowView& view, DepthFormat format) {
    const double step = depth_format_row(format).step;
    if (view.projection == ViewProjection::orthographic) return step * (view.far_m - view.near_m);
    return step * view.far_m * view.far_m / std::abs(view.depth_beta);  // d(alpha + beta / z)
}

/// The light's views, without casters, for maps of its demand's size. False if no finite volume exists.
bool fit_light(const SceneSnapshot& scene, const HeldLight& held, std::uint32_t d, HeldLight& next,
               ShadowFrame& frame) {
    const PotentialSets& sets = frame.sets[d];
    const ShadowDemand& demand = frame.demands[d];
    const LightItem& light = scene.lights[demand.light];
    const auto points =
        std::span(frame.receiver_points_ws).subspan(sets.receiver_points.first, sets.receiver_points.count);
    const FitInput input{light,
                         demand,
                         scene,
                         std::span(frame.receiver_items).subspan(sets.receivers.first, sets.receivers.count),
                         std::span(frame.caster_items).subspan(sets.casters.first, sets.casters.count),
                         points,
                         std::span(frame.beams).subspan(sets.beams.first, sets.beams.count),
                         frame.receiver_points_ws,
                         demand.filtering.border_texel,
                         frame.fit_scratch,
                         held,
                         next};
    const std::size_t first = frame.views.size();
    if (!light_kind_row(light.kind).fit(input, frame.views)) return false;
    for (std::size_t v = first; v < frame.views.size(); ++v) {
        ShadowView& view = frame.views[v];
        view.demand = d;
        state_receivers(light, sets, frame, view);
        state_errors(scene, points, edge_texel_at(demand.filtering, finest_texel_m(view)), view);
    }
    return true;
}

/// Makes the light's maps the size that keeps its word; smaller than the last frame's not at once. True if that is
/// another one than they were fitted for.
bool settle_size(const LightItem& light, std::span<const ShadowView> views, const HeldLight& held,
                 std::uint32_t& spare_frames, ShadowDemand& demand) {
    if (views.empty() || !follows_contract(light, demand)) return false;
    double predicted_px = 0.0;
    for (const ShadowView& view : views) predicted_px = std::max(predicted_px, view.predicted_error_px);
    const bool is_held = demand.resolution_px == held.map_px;
    const std::uint32_t size_px =
        contract_size_px(demand.resolution_px, is_held, predicted_px, wished_error_px(light.shadow), demand.most_px);
    const bool spare = is_held && size_px < demand.resolution_px;
    // Beyond kSpareFrames it was tried, and found too little: a filter's border is a larger share of a smaller map.
    if (is_held) spare_frames = spare ? std::min(held.spare_frames + 1, kSpareFrames + 1) : 0;
    if (size_px == demand.resolution_px || (spare && spare_frames != kSpareFrames)) return false;
    set_resolution(light, size_px, demand);
    return true;
}

}  // namespace

void fit_views(const SceneSnapshot& scene, const History& held, ShadowFrame& frame) {
    const HeldLight none;
    frame.views.clear();
    frame.next_history.lights.clear();
    frame.view_caster_items.clear();
    for (std::uint32_t d = 0; d < frame.demands.size(); ++d) {
        PotentialSets& sets = frame.sets[d];
        ShadowDemand& demand = frame.demands[d];
        if (demand.skip != Reason::none) continue;
        const LightTime time(frame, demand.light);
        const LightItem& light = scene.lights[demand.light];
        const HeldLight* last = find(held, light.entity, frame.next_history.lights.size());
        HeldLight& next = frame.next_history.lights.emplace_back(last ? *last : none);
        next.light = light.entity;
        if (sets.skip != Reason::none) continue;
        const HeldLight before = next;
        const std::size_t first = frame.views.size();
        bool fitted = fit_light(scene, before, d, next, frame);
        std::uint32_t spare_frames = 0;
        for (int again = 0; again < kMostSizes && fitted; ++again) {
            if (!settle_size(light, std::span(frame.views).subspan(first), before, spare_frames, demand)) break;
            frame.views.resize(first);
            next = before;
            fitted = fit_light(scene, before, d, next, frame);
        }
        if (!fitted) {
            frame.views.resize(first);
            sets.skip = Reason::fit_degenerate;
            continue;
        }
        if (frame.views.size() == first) sets.skip = Reason::no_caster;  // none where its shadow would be seen
        next.map_px = follows_contract(light, demand) ? demand.resolution_px : 0;
        next.spare_frames = next.map_px == before.map_px ? spare_frames : 0;
        for (std::size_t v = first; v < frame.views.size(); ++v) {
            const ShadowView& view = frame.views[v];
            if (depth_step_m(view, demand.depth_format) > view.texel_m && view.texel_m > 0.0 &&
                demand.note == Reason::none)
                demand.note = Reason::depth_coarse;
        }
        for (std::size_t v = first; v < frame.views.size(); ++v) select_view_casters(scene, frame.views[v], frame);
    }
}

}  // namespace gnomon::shadow
