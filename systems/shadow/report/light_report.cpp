#include "systems/shadow/report/light_report.h"

#include <algorithm>

#include "systems/shadow/publish/lookup_accuracy.h"

namespace gnomon::shadow {
namespace {

/// Of a view that the fits left out: nothing is seen in it, or nothing stands before what is.
Reason why_left_out(const LightItem& light, const PotentialSets& sets, const ShadowFrame& frame, std::uint32_t layer,
                    Why& why) {
    if (light.kind == LightKind::directional) return Reason::no_visible_receiver;
    why.receivers = frame.beams[sets.beams.first + layer].receivers;
    return why.receivers == 0 ? Reason::no_visible_receiver : Reason::no_caster;
}

Reason why_reused(const ShadowSlot& slot) {
    return slot.hold == Hold::none ? Reason::content_unchanged : Reason::refresh_held;
}

/// Views [first, end) of the frame are the light's.
void explain_views(const LightItem& light, const ShadowDemand& demand, const ShadowFrame& frame, std::size_t first,
                   std::size_t end, std::optional<double> view_us, FrameReport& report, LightReport& out) {
    out.first_view = static_cast<std::uint32_t>(report.views.size());
    out.view_count = demand.view_count;
    for (std::uint32_t layer = 0; layer < demand.view_count; ++layer) {
        ViewReport& view = report.views.emplace_back();
        view.layer = layer;
        std::size_t v = first;
        while (v < end && frame.views[v].layer != layer) ++v;
        if (v == end) {
            view.state = LightState::skipped;
            view.reason = why_left_out(light, frame.sets[demand.light], frame, layer, view.why);
        } else {
            view.why.receivers = frame.views[v].receivers;
            view.why.casters = frame.views[v].casters.count;
            view.why.stale_px = frame.slots[v].stale.error_px;
            if (frame.slots[v].reuse) view.state = LightState::reused;
            if (frame.slots[v].reuse) view.reason = why_reused(frame.slots[v]);
            if (!frame.slots[v].texture) view.state = LightState::skipped;  // rays do without
            if (!frame.slots[v].texture) view.reason = demand.left_to_rays ? Reason::rays_cheaper : demand.note;
            if (frame.views[v].lit) view.state = LightState::skipped;
            if (frame.views[v].lit) view.reason = Reason::no_caster;
        }
        if (view.state == LightState::rendered) continue;
        view.why.bytes_saved = out.bytes / demand.view_count;
        view.why.saved_us = view_us;
    }
}

/// `lost`: there is neither a map to look up nor a ray to ask. `drawn`: what the light looks up was made or changed in
/// this frame. `held`: a view of its maps shows casters as they were.
void explain_state(const PotentialSets& sets, const ShadowDemand& demand, const LightHistory* history, bool lost,
                   bool drawn, bool held, LightReport& out) {
    out.reason = sets.skip;
    if (out.reason != Reason::none) {
        out.state = LightState::skipped;
    } else if (lost) {
        out.state = LightState::skipped;
        out.reason = demand.note;
    } else if (history && history->failure != Reason::none) {
        out.state = LightState::degraded;
        out.reason = history->failure;
    } else if (demand.over_budget) {
        out.state = LightState::degraded;
        out.reason = Reason::budget_shrunk;
    } else if (demand.note != Reason::none) {
        out.state = LightState::degraded;
        out.reason = demand.note;
    } else if (demand.left_to_rays) {
        out.state = LightState::rendered;
        out.reason = Reason::rays_cheaper;
    } else if (!drawn) {
        out.state = LightState::reused;
        out.reason = held ? Reason::refresh_held : Reason::content_unchanged;
    } else {
        out.state = LightState::rendered;
    }
}

/// `filter`: that it is published with; another one than its own for want of something, as its demand notes.
FilterReport filter_report(const ShadowDemand& demand, ShadowFilter filter) {
    if (filter != demand.filter) return {filter, demand.note, {}};
    FilterReport out{demand.filter, Reason::none, {}};
    if (demand.usual_px > 0.0) out.reason = Reason::map_too_coarse;
    if (demand.usual_px > 0.0) out.usual_error_px = demand.usual_px;
    return out;
}

/// Of the whole light: what its views saved; all of them, and its map, if it is skipped.
void explain_savings(const LightItem& light, const ShadowDemand& demand, std::optional<double> view_us,
                     const FrameReport& report, LightReport& out) {
    if (!light.has_shadow) return;
    if (out.state == LightState::skipped) {
        const std::uint64_t wanted = map_bytes(light, demand);
        out.why.bytes_saved = wanted - std::min(wanted, out.bytes);
        if (view_us) out.why.saved_us = *view_us * demand.view_count;
        return;
    }
    for (const ViewReport& view : report.views_of(out)) {
        out.why.bytes_saved += view.why.bytes_saved;
        if (view_us && view.state != LightState::rendered) out.why.saved_us = out.why.saved_us.value_or(0.0) + *view_us;
    }
}

}  // namespace

void explain_lights(const SceneSnapshot& scene, const ShadowFrame& frame, const MapStore& maps, const DrawTimes& times,
                    const DimLights& dim, bool rays, FrameReport& report) {
    report.views.clear();
    const bool trees_changed = report.rays.meshes_written > 0 || report.rays.instances_written;
    std::size_t first = 0, end = 0;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i, first = end) {
        const LightItem& light = scene.lights[i];
        const ShadowDemand& demand = frame.demands[i];
        const PotentialSets& sets = frame.sets[i];
        LightReport& out = report.lights[i];
        out.entity = light.entity;
        out.name = light.name;
        out.kind = light.kind;
        out.cpu_us = frame.cpu_us[i];
        const LightHistory* history = maps.find(light.entity);
        if (history && history->texture) {
            out.texels = std::uint64_t{history->desc.width} * history->desc.height * gl::layer_count(history->desc);
            out.bytes = MapStore::bytes(*history);
        }
        while (end < frame.views.size() && frame.views[end].demand == i) ++end;
        const bool exact = demand.asks_rays && rays;
        const ShadowFilter filter = published_filter(demand, first < end ? frame.slots[first] : ShadowSlot{}, rays);
        LookupAccuracy shown{filter, 0.0, false};
        bool held = false;
        for (std::size_t v = first; v < end; ++v) {
            if (!frame.slots[v].texture || frame.views[v].lit) continue;
            ++out.views;
            held = held || frame.slots[v].hold != Hold::none;
            out.why.stale_px = std::max(out.why.stale_px, frame.slots[v].stale.error_px);
            add_view(light, demand, frame.views[v], frame.slots[v], shown);
        }
        if (!exact) out.predicted_error_px = shown.predicted_error_px;
        const bool lost = demand.asks_rays && filter == ShadowFilter::automatic;
        explain_state(sets, demand, history, lost, out.views_drawn > 0 || (exact && trees_changed), held, out);
        out.keeps_max_error = (exact && sets.skip == Reason::none && demand.skip == Reason::none) ||
                              (shown.keeps_max_error && !exact && history->failure == Reason::none);
        out.why.receivers = sets.receivers.count;
        out.why.casters = sets.casters.count;
        out.why.display_steps = dim.steps(i);
        const std::optional<double> view_us = times.view_us(light.entity);
        if (out.state != LightState::skipped) out.filter = filter_report(demand, filter);
        if (out.state != LightState::skipped) explain_views(light, demand, frame, first, end, view_us, report, out);
        explain_savings(light, demand, view_us, report, out);
    }
}

}  // namespace gnomon::shadow
