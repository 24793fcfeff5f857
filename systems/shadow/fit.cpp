#include "systems/shadow/fit.h"

#include <algorithm>

#include "systems/shadow/light_kinds.h"
#include "systems/shadow/light_time.h"
#include "systems/shadow/predicted_error.h"
#include "systems/shadow/view_casters.h"

namespace gnomon::shadow {
namespace {

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

}  // namespace

void fit_views(const SceneSnapshot& scene, const History& held, ShadowFrame& frame) {
    const HeldLight none;
    frame.views.clear();
    frame.next_history.lights.clear();
    frame.view_caster_items.clear();
    for (std::uint32_t d = 0; d < frame.demands.size(); ++d) {
        PotentialSets& sets = frame.sets[d];
        const ShadowDemand& demand = frame.demands[d];
        if (demand.skip != Reason::none) continue;
        const LightTime time(frame, demand.light);
        const LightItem& light = scene.lights[demand.light];
        const HeldLight* last = find(held, light.entity, frame.next_history.lights.size());
        HeldLight& next = frame.next_history.lights.emplace_back(last ? *last : none);
        next.light = light.entity;
        if (sets.skip != Reason::none) continue;
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
                             last ? *last : none,
                             next};
        const std::size_t first = frame.views.size();
        if (!light_kind_row(light.kind).fit(input, frame.views)) {
            frame.views.resize(first);
            sets.skip = Reason::fit_degenerate;
            continue;
        }
        if (frame.views.size() == first) sets.skip = Reason::no_caster;  // none where its shadow would be seen
        for (std::size_t v = first; v < frame.views.size(); ++v) {
            ShadowView& view = frame.views[v];
            view.demand = d;
            state_receivers(light, sets, frame, view);
            select_view_casters(scene, view, frame);
            state_errors(scene, points, edge_texel_at(demand.filtering, finest_texel_m(view)), view);
        }
    }
}

}  // namespace gnomon::shadow
