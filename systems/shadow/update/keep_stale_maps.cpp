#include "systems/shadow/update/keep_stale_maps.h"

#include <algorithm>
#include <cmath>

#include "systems/shadow/update/stale_error.h"
#include "systems/shadow/update/update_scheduler.h"

namespace gnomon::shadow {
namespace {

/// Calls `use` with the range of views of each cube that has a map.
template <class Use>
void for_each_cube(const UpdateInputs& inputs, const std::vector<UpdatePlan>& plans, Use use) {
    for (const FitChoice& light : inputs.fitted.lights) {
        const IndexRange range = light.views;
        if (range.count == 0 || inputs.fitted.views[range.first].projection != ViewProjection::cube_face) continue;
        if (inputs.maps[range.first].texture && !plans[range.first].skipped_for_rays) use(range);
    }
}

/// Gives all faces of a cube that are due one joint staleness, so that they are kept or drawn together. A cube is
/// looked up with one offset, that of the face with the farthest movement.
void join_cubes(const UpdateInputs& inputs, std::vector<UpdatePlan>& plans) {
    for_each_cube(inputs, plans, [&](IndexRange range) {
        Staleness all;
        double metre_px = 0.0;
        for (std::size_t v = range.first; v < range.end(); ++v) {
            const double face_px = inputs.fitted.views[v].error.metre_px;
            metre_px = std::max(metre_px, face_px);
            if (plans[v].reuse) continue;
            const Staleness& face = plans[v].if_held;
            all.moved_m = std::max(all.moved_m, face.moved_m);
            // The error without the face's own offset. It is NaN for an unknown error.
            const double across_px = face.error_px - face.moved_m * face_px;
            all.error_px = std::max(all.error_px, std::isnan(across_px) ? face.error_px : across_px);
        }
        all.error_px += all.moved_m * metre_px;
        for (std::size_t v = range.first; v < range.end(); ++v)
            if (!plans[v].reuse) plans[v].if_held = all;
    });
}

/// Returns whether a budget draws this view in another frame, because the light's views are drawn in turn.
bool is_others_turn(const UpdateInputs& inputs, std::size_t v, std::uint64_t frame, const UpdatePlan& plan) {
    const ShadowView& view = inputs.fitted.views[v];
    const std::uint32_t every = inputs.decisions[view.light].refresh_frames;
    return every > 1 && (frame + view.light + view.layer) % every != 0 && plan.waited_frames < kMostWait_frames;
}

/// Returns why the layer is kept; Hold::none: it is drawn.
Hold hold_of(const SceneSnapshot& scene, const UpdateInputs& inputs, std::size_t v, std::uint64_t frame,
             const UpdatePlan& plan) {
    const LightItem& light = scene.lights[inputs.fitted.views[v].light];
    const double error_px = plan.if_held.error_px;
    if (!std::isfinite(error_px)) return Hold::none;
    if (may_be_held(light) && error_px <= static_cast<double>(light.shadow.refresh_error_px)) return Hold::within_error;
    return is_others_turn(inputs, v, frame, plan) ? Hold::by_turn : Hold::none;
}

}  // namespace

bool may_be_held(const LightItem& light) {
    return light.shadow.refresh_error_px > 0.0f && light.tuning.bias.mode == BiasMode::automatic;
}

Staleness staleness_if_held(const SceneSnapshot& scene, const UpdateInputs& inputs, std::size_t v,
                            const CachedMap& cached, std::uint64_t shown_content) {
    const ShadowView& view = inputs.fitted.views[v];
    const MapAssignment& map = inputs.maps[v];
    const bool certain = static_cast<bool>(map.sheets.second);  // a stale conservative map would classify wrongly
    const bool shows_it = shown_content != 0 && cached.layers.placements[view.layer] == map.content.placement;
    if (certain || !scene.lights[view.light].tuning.reuse.economy || !shows_it ||
        view.layer >= cached.layers.shown.size())
        return kUnknownStaleness;
    return staleness(scene, view, cached.layers.shown[view.layer], map.content.still, inputs.fitted.casters_of(view));
}

void keep_stale_maps(const SceneSnapshot& scene, const UpdateInputs& inputs, std::uint64_t frame,
                     std::vector<UpdatePlan>& plans) {
    join_cubes(inputs, plans);
    for (std::size_t v = 0; v < plans.size(); ++v) {
        UpdatePlan& plan = plans[v];
        if (!inputs.maps[v].texture || plan.reuse) continue;
        const Hold hold = hold_of(scene, inputs, v, frame, plan);
        plan.changed = hold != Hold::within_error && plan.shown_content != 0;
        if (hold != Hold::none) keep_layer(plan, hold);
    }
}

void share_offsets(const UpdateInputs& inputs, std::vector<UpdatePlan>& plans) {
    for_each_cube(inputs, plans, [&](IndexRange range) {
        double moved_m = 0.0;
        for (std::size_t v = range.first; v < range.end(); ++v) moved_m = std::max(moved_m, plans[v].stale.moved_m);
        for (std::size_t v = range.first; v < range.end(); ++v) {
            Staleness& stale = plans[v].stale;
            stale.error_px += (moved_m - stale.moved_m) * inputs.fitted.views[v].error.metre_px;
            stale.moved_m = moved_m;
        }
    });
}

}  // namespace gnomon::shadow
