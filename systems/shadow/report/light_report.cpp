#include "systems/shadow/report/light_report.h"

#include <algorithm>

#include "systems/extract/light_facts.h"
#include "systems/shadow/publish/lookup_accuracy.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {
namespace {

/// Explains a view that the fits left out: no receiver is visible in it, or no caster stands before the visible ones.
Reason why_left_out(const LightItem& light, std::span<const ReceiverHull> hulls, std::uint32_t layer, Why& why) {
    if (light_facts(light.kind).parallel) return Reason::no_visible_receiver;
    why.receivers = hulls[layer].receivers;
    return why.receivers == 0 ? Reason::no_visible_receiver : Reason::no_caster;
}

Reason why_reused(const UpdatePlan& plan) {
    return plan.hold == Hold::none ? Reason::content_unchanged : Reason::refresh_held;
}

/// Returns whether rays replace any of the light's maps in this frame.
bool is_left_to_rays(const DrawnViews& drawn, std::uint32_t light) {
    const IndexRange views = drawn.fitted.lights[light].views;
    return views.count > 0 && drawn.updates[views.first].skipped_for_rays;
}

/// Explains the state of view `v`.
void explain_view(const DrawnViews& drawn, std::size_t v, ViewReport& view) {
    const UpdatePlan& plan = drawn.updates[v];
    const bool has_map = drawn.has_map(v);
    view.why.receivers = drawn.view(v).receivers;
    view.why.casters = drawn.view(v).casters.count;
    if (has_map) view.why.stale_px = plan.stale.error_px;
    if (has_map && plan.reuse) view.state = LightState::reused;
    if (has_map && plan.reuse) view.reason = why_reused(plan);
    if (!has_map) view.state = LightState::skipped;  // rays replace the map
    if (!has_map)
        view.reason = plan.skipped_for_rays ? Reason::rays_cheaper : drawn.statuses[drawn.view(v).light].degraded();
    if (drawn.view(v).lit) view.state = LightState::skipped;
    if (drawn.view(v).lit) view.reason = Reason::no_caster;
}

/// Explains the state of each view that the light's map has room for.
void explain_views(const ReportInputs& in, const LightItem& light, std::uint32_t index, FrameReport& report) {
    LightReport& out = report.lights[index];
    const std::uint32_t count = in.drawn.lights[index].request.map.view_count;
    const IndexRange views = in.drawn.fitted.lights[index].views;
    const std::optional<double> view_us = in.times.view_us(light.entity);
    out.views.first = static_cast<std::uint32_t>(report.views.size());
    out.views.count = count;
    for (std::uint32_t layer = 0; layer < count; ++layer) {
        ViewReport& view = report.views.emplace_back();
        view.layer = layer;
        std::size_t v = views.first;
        while (v < views.end() && in.drawn.view(v).layer != layer) ++v;
        if (v == views.end()) {
            view.state = LightState::skipped;
            view.reason = why_left_out(light, in.drawn.fitted.sets_of(in.sets, index).hulls(), layer, view.why);
        } else {
            explain_view(in.drawn, v, view);
        }
        if (view.state == LightState::rendered) continue;
        view.why.bytes_saved = out.counts.bytes / count;
        view.why.saved_us = view_us;
    }
}

/// Inputs of a light's state, beside its status.
struct LookupState {
    bool lost = false;   // there is neither a map to look up nor rays to trace
    bool drawn = false;  // what the light looks up was made or changed in this frame
    bool stale = false;  // a layer of its maps shows earlier casters
    bool skipped_for_rays = false;
};

void explain_state(const LightStatus& status, const BudgetDecision& decision, const CachedMap* cached,
                   const LookupState& lookup, LightReport& out) {
    out.reason = status.skipped();
    if (status.is_skipped()) {
        out.state = LightState::skipped;
    } else if (lookup.lost) {
        out.state = LightState::skipped;
        out.reason = status.degraded();
    } else if (cached && cached->allocation.failure != Reason::none) {
        out.state = LightState::degraded;
        out.reason = cached->allocation.failure;
    } else if (decision.over_budget) {
        out.state = LightState::degraded;
        out.reason = Reason::budget_shrunk;
    } else if (status.degraded() != Reason::none) {
        out.state = LightState::degraded;
        out.reason = status.degraded();
    } else if (lookup.skipped_for_rays) {
        out.state = LightState::rendered;
        out.reason = Reason::rays_cheaper;
    } else if (!lookup.drawn) {
        out.state = LightState::reused;
        out.reason = lookup.stale ? Reason::refresh_held : Reason::content_unchanged;
    } else {
        out.state = LightState::rendered;
    }
}

/// Reports the filter that the light is published with. If it replaces the light's own, the status gives the reason.
FilterReport filter_report(const DrawnViews& drawn, std::uint32_t light, ShadowFilter filter) {
    const ShadowFilter own = drawn.lights[light].request.map.filter;
    if (filter != own) return {filter, drawn.statuses[light].degraded(), {}, {}};
    FilterReport out{own, Reason::none, {}, {}};
    const MapAccuracy& usual = drawn.fitted.lights[light].default_filter;
    if (!(usual.edge_px > 0.0)) return out;
    out.reason = Reason::map_too_coarse;
    out.usual_error_px = usual.edge_px;
    out.usual_resolved_px = usual.resolved_px;
    return out;
}

/// Reports what the light's views saved; if it is skipped, all of them and its map.
void explain_savings(const LightItem& light, const ShadowRequest& request, std::optional<double> view_us,
                     const FrameReport& report, LightReport& out) {
    if (!light.has_shadow) return;
    if (out.state == LightState::skipped) {
        const std::uint64_t wanted = map_bytes(light, request);
        out.why.bytes_saved = wanted - std::min(wanted, out.counts.bytes);
        if (view_us) out.why.saved_us = *view_us * request.map.view_count;
        return;
    }
    for (const ViewReport& view : report.views_of(out)) {
        out.why.bytes_saved += view.why.bytes_saved;
        if (view_us && view.state != LightState::rendered) out.why.saved_us = out.why.saved_us.value_or(0.0) + *view_us;
    }
}

/// Counts the casters of a light that its filter treats by depth, where it reads triangles of others.
std::uint32_t casters_by_depth(const SceneSnapshot& scene, const LightSetsView& sets, ShadowFilter filter) {
    if (!scene.drawables.any_by_depth || filter == ShadowFilter::automatic || !filter_row(filter).storage.triangle_ids)
        return 0;
    const auto casters = sets.casters();
    return static_cast<std::uint32_t>(std::count_if(
        casters.begin(), casters.end(), [&](std::uint32_t i) { return scene.instances[i].drawable.by_depth; }));
}

void explain_light(const SceneSnapshot& scene, const ReportInputs& in, std::uint32_t i, FrameReport& report) {
    const LightItem& light = scene.lights[i];
    const LightStatus& status = in.drawn.statuses[i];
    const BudgetDecision& decision = in.drawn.lights[i];
    LightReport& out = report.lights[i];
    out.entity = light.entity;
    out.name = light.name;
    out.kind = light.kind;
    out.cpu_us = in.cpu_us[i];
    const CachedMap* cached = in.maps.find(light.entity);
    if (cached && cached->texture) {
        out.counts.texels = std::uint64_t{cached->desc.width} * cached->desc.height * gl::layer_count(cached->desc);
        out.counts.bytes = MapCache::bytes(*cached);
        out.counts.parts = MapCache::parts(*cached);
    }
    out.counts.parts.tints = in.tints.bytes(light.entity);
    out.counts.bytes += out.counts.parts.tints;
    const ShadowFilter filter = published_filter(in.drawn, i, in.has_rays);
    LookupAccuracy shown{filter, 0.0, false};
    LookupState lookup;
    const IndexRange views = in.drawn.fitted.lights[i].views;
    for (std::size_t v = views.first; v < views.end(); ++v) {
        if (!in.drawn.has_map(v) || in.drawn.view(v).lit) continue;
        ++out.counts.views;
        lookup.stale = lookup.stale || in.drawn.updates[v].hold != Hold::none;
        out.why.stale_px = std::max(out.why.stale_px, in.drawn.updates[v].stale.error_px);
        add_view(light, in.drawn, v, shown);
    }
    const bool uses_rays = decision.request.rays.used, exact = uses_rays && in.has_rays;
    const bool trees_changed = report.rays.meshes_written > 0 || report.rays.instances_written;
    if (!exact) out.predicted_error_px = shown.predicted_error_px;
    if (!exact) out.resolved = shown.resolved;
    lookup.lost = uses_rays && filter == ShadowFilter::automatic;
    lookup.drawn = out.counts.views_drawn > 0 || (exact && trees_changed);
    lookup.skipped_for_rays = is_left_to_rays(in.drawn, i);
    explain_state(status, decision, cached, lookup, out);
    const bool keeps = exact ? !status.is_skipped() : cached && cached->allocation.failure == Reason::none;
    out.keeps_max_error = keeps && (exact || shown.keeps_max_error);
    out.resolved.keeps_narrowest = keeps && (exact || shown.resolved.keeps_narrowest);
    const LightSetsView sets = in.drawn.fitted.sets_of(in.sets, i);
    out.why.receivers = sets.ranges.receivers.count;
    out.why.casters = sets.ranges.casters.count;
    out.why.display_steps = in.dim.steps(i);
    out.counts.by_depth = casters_by_depth(scene, sets, filter);
    if (out.state != LightState::skipped) out.filter = filter_report(in.drawn, i, filter);
    if (out.state != LightState::skipped) explain_views(in, light, i, report);
    explain_savings(light, decision.request, in.times.view_us(light.entity), report, out);
}

}  // namespace

void explain_lights(const SceneSnapshot& scene, const ReportInputs& in, FrameReport& report) {
    report.views.clear();
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) explain_light(scene, in, i, report);
}

}  // namespace gnomon::shadow
