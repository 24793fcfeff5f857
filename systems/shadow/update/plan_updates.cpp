#include "systems/shadow/update/plan_updates.h"

#include <algorithm>
#include <cmath>

#include "engine/core/signature.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/update/cube_layering.h"
#include "systems/shadow/update/keep_stale_maps.h"
#include "systems/shadow/update/skip_map_for_rays.h"
#include "systems/shadow/update/static_caster_copy.h"

namespace gnomon::shadow {
namespace {

/// Compares what layers show with what they are to show.
void compare_layers(const SceneSnapshot& scene, const UpdateInputs& inputs, const MapCache& maps,
                    std::vector<UpdatePlan>& plans) {
    for (std::size_t v = 0; v < plans.size(); ++v) {
        const MapAssignment& map = inputs.maps[v];
        if (!map.texture) continue;
        const ShadowView& view = inputs.fitted.views[v];
        const LightItem& light = scene.lights[view.light];
        const CachedMap& cached = *maps.find(light.entity);
        UpdatePlan& plan = plans[v];
        plan.content = map.content.all;
        plan.reuse = view.lit || (light.tuning.reuse.economy && cached.layers.content[view.layer] == plan.content);
        if (plan.reuse) continue;
        plan.shown_content = cached.layers.content[view.layer];
        plan.if_held = staleness_if_held(scene, inputs, v, cached, plan.shown_content);
        if (view.layer < cached.layers.shown.size()) plan.waited_frames = cached.layers.shown[view.layer].waited_frames;
    }
}

/// Defers views where all that are due would take more time than the budget leaves for drawing in one frame.
void defer_views(const SceneSnapshot& scene, const GpuScene& gpu, const UpdateInputs& inputs, std::vector<DueView>& due,
                 std::vector<UpdatePlan>& plans) {
    if (!inputs.allowance.limited) return;
    due.clear();
    for (std::size_t v = 0; v < plans.size(); ++v) {
        const UpdatePlan& plan = plans[v];
        if (!inputs.maps[v].texture || plan.skipped_for_rays || plan.reuse) continue;
        const ShadowView& view = inputs.fitted.views[v];
        const BudgetDecision& decision = inputs.decisions[view.light];
        const MapSettings& map = decision.request.map;
        const DrawCounts counts = count_draws(scene, gpu, inputs.fitted.casters_of(view));
        const double casters = filter_row(map.filter).storage.work.casters;
        const double ns = drawing_ns(map, inputs.maps[v].size_px, 1.0, static_cast<double>(counts.triangles) * casters,
                                     static_cast<double>(counts.draws) * casters);
        const bool may_wait = std::isfinite(plan.if_held.error_px) && plan.waited_frames < kMostWait_frames;
        const double harm = may_wait ? decision.weight * edge_error_cost(plan.if_held.error_px) : DueView::kMustNotWait;
        due.push_back({v, ns * inputs.allowance.factor, harm, plan.content});
    }
    const std::size_t waiting = choose_waiting(inputs.allowance.room_ns, due);
    for (std::size_t i = 0; i < waiting; ++i) keep_layer(plans[due[i].view], Hold::by_turn);
}

/// Returns whether two faces of a cube are opposite. OpenGL numbers such faces side by side.
bool are_opposite_faces(std::uint32_t a, std::uint32_t b) { return a != b && a / 2 == b / 2; }

/// Plans the prefiltered maps. A view's moments depend on its own depths and, in a cube, on those of adjacent faces.
void plan_prefiltering(const SceneSnapshot& scene, const UpdateInputs& inputs, const MapCache& maps,
                       std::vector<UpdatePlan>& plans) {
    for (std::size_t v = 0; v < plans.size(); ++v) {
        if (!inputs.maps[v].prefiltered.moments || plans[v].skipped_for_rays) continue;
        const ShadowView& view = inputs.fitted.views[v];
        const LightItem& light = scene.lights[view.light];
        const MapSettings& map = inputs.decisions[view.light].request.map;
        Signature s;
        s.add(static_cast<std::uint64_t>(map.filter));
        s.add(std::uint64_t{map.filtering.size});
        s.add(map.moments.settings.x);
        s.add(map.moments.settings.y);
        const IndexRange range = inputs.fitted.lights[view.light].views;
        for (std::size_t other = range.first; other < range.end(); ++other) {
            const std::uint32_t layer = inputs.fitted.views[other].layer;
            const bool beside = view.projection == ViewProjection::cube_face && !are_opposite_faces(layer, view.layer);
            if (other != v && !beside) continue;
            s.add(std::uint64_t{layer});
            s.add(plans[other].content);
        }
        const std::uint64_t shown = maps.find(light.entity)->moments.content[view.layer];
        plans[v].moment_content = s.value();
        plans[v].convert = !view.lit && (!light.tuning.reuse.economy || shown != s.value());
    }
}

/// Marks the views in which the engine draws casters.
void mark_engine_draws(const SceneSnapshot& scene, const UpdateInputs& inputs, std::vector<UpdatePlan>& plans) {
    if (!scene.drawables.any_drawn) return;
    for (std::size_t v = 0; v < plans.size(); ++v) {
        if (!inputs.maps[v].texture || plans[v].skipped_for_rays || plans[v].reuse) continue;
        const auto casters = inputs.fitted.casters_of(inputs.fitted.views[v]);
        plans[v].begun_by_engine = std::any_of(casters.begin(), casters.end(),
                                               [&](std::uint32_t i) { return scene.instances[i].drawable.drawn; });
    }
}

/// Chooses how the faces of cubes are drawn: one pass per face, or one for all.
void choose_routes(const SceneSnapshot& scene, const UpdateInputs& inputs, MapCache& maps,
                   std::vector<UpdatePlan>& plans) {
    const auto drawn = [&](std::size_t v) {
        return inputs.maps[v].texture && !plans[v].skipped_for_rays && !plans[v].reuse;
    };
    for (std::uint32_t i = 0; i < inputs.fitted.lights.size(); ++i) {
        const IndexRange range = inputs.fitted.lights[i].views;
        if (range.count == 0 || inputs.fitted.views[range.first].projection != ViewProjection::cube_face) continue;
        std::uint32_t faces = 0;
        bool apart = static_cast<bool>(inputs.maps[range.first].sheets.second);  // these are peeled face by face
        for (std::size_t v = range.first; v < range.end(); ++v) {
            faces += drawn(v) ? 1 : 0;
            apart = apart || plans[v].copy.use != StaticCopyUse::none || plans[v].begun_by_engine;
        }
        if (faces == 0 || apart) continue;
        const CubeRoute route = cube_route(scene.lights[i].tuning.maps.cube_route, maps.device(), faces);
        if (route == CubeRoute::six_passes) continue;
        const gl::TargetHandle whole = maps.whole_target(maps.entry(scene.lights[i].entity));
        for (std::size_t v = range.first; v < range.end(); ++v) {
            if (!drawn(v) || !whole) continue;
            plans[v].whole = whole;
            plans[v].route = route;
        }
    }
}

}  // namespace

void plan_updates(const SceneSnapshot& scene, const GpuScene& gpu, const UpdateInputs& inputs, MapCache& maps,
                  std::vector<DueView>& due, std::vector<UpdatePlan>& plans) {
    plans.assign(inputs.fitted.views.size(), {});
    compare_layers(scene, inputs, maps, plans);
    keep_stale_maps(scene, inputs, maps.frame(), plans);
    skip_maps_for_rays(scene, gpu, inputs, maps, plans);
    defer_views(scene, gpu, inputs, due, plans);
    share_offsets(inputs, plans);
    for (std::size_t v = 0; v < plans.size(); ++v)
        if (plans[v].hold == Hold::by_turn) maps.entry(scene.lights[inputs.fitted.views[v].light].entity).waits = true;
    plan_prefiltering(scene, inputs, maps, plans);
    mark_engine_draws(scene, inputs, plans);
    copy_static_casters(scene, gpu, inputs, maps, plans);
    choose_routes(scene, inputs, maps, plans);
}

void keep_all(std::span<const MapAssignment> maps, std::vector<UpdatePlan>& plans) {
    for (std::size_t v = 0; v < plans.size(); ++v) {
        UpdatePlan& plan = plans[v];
        plan.reuse = static_cast<bool>(maps[v].texture) && !plan.skipped_for_rays;
        plan.convert = false;
        plan.whole = {};
        plan.route = CubeRoute::six_passes;
        plan.copy.use = StaticCopyUse::none;
        plan.begun_by_engine = false;
    }
}

}  // namespace gnomon::shadow
