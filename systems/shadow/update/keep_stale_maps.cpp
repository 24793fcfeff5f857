#include <algorithm>
#include <cmath>

#include "systems/shadow/budget/update_scheduler.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/update/stale_error.h"

/// The part of stage 5 that lets layers go on showing casters as they were.
namespace gnomon::shadow {
namespace {

/// An offset that is chosen by hand says nothing of what keeps a moved caster from darkening itself.
bool may_be_held(const LightItem& light) {
    return light.shadow.refresh_error_px > 0.0f && light.tuning.bias.mode == BiasMode::automatic;
}

bool is_cube(const ShadowFrame& frame, std::size_t v) { return frame.views[v].projection == ViewProjection::cube_face; }

/// Calls with the range of views of each cube that has a map.
template <class Use>
void for_each_cube(const ShadowFrame& frame, Use use) {
    for (std::size_t first = 0, end = 0; first < frame.views.size(); first = end) {
        while (end < frame.views.size() && frame.views[end].demand == frame.views[first].demand) ++end;
        if (is_cube(frame, first) && frame.slots[first].texture) use(first, end);
    }
}

/// A cube is looked up with one offset, that of the face whose casters moved farthest. So its faces are kept together,
/// or drawn together, as many as show other than they should.
void join_cubes(ShadowFrame& frame) {
    for_each_cube(frame, [&](std::size_t first, std::size_t end) {
        Staleness all;
        double metre_px = 0.0;
        for (std::size_t v = first; v < end; ++v) {
            metre_px = std::max(metre_px, frame.views[v].metre_px);
            if (frame.slots[v].reuse) continue;
            const Staleness& face = frame.slots[v].if_held;
            all.moved_m = std::max(all.moved_m, face.moved_m);
            // Without its own offset; of what cannot be told that is no number.
            const double across_px = face.error_px - face.moved_m * frame.views[v].metre_px;
            all.error_px = std::max(all.error_px, std::isnan(across_px) ? face.error_px : across_px);
        }
        all.error_px += all.moved_m * metre_px;
        for (std::size_t v = first; v < end; ++v)
            if (!frame.slots[v].reuse) frame.slots[v].if_held = all;
    });
}

/// What of that is so for the faces that show what they should, but for the offset.
void share_offsets(ShadowFrame& frame) {
    for_each_cube(frame, [&](std::size_t first, std::size_t end) {
        double moved_m = 0.0;
        for (std::size_t v = first; v < end; ++v) moved_m = std::max(moved_m, frame.slots[v].stale.moved_m);
        for (std::size_t v = first; v < end; ++v) {
            Staleness& stale = frame.slots[v].stale;
            stale.error_px += (moved_m - stale.moved_m) * frame.views[v].metre_px;
            stale.moved_m = moved_m;
        }
    });
}

}  // namespace

/// Whether others are drawn in this frame, of those that a budget lets take turns.
bool MapStore::is_others_turn(const ShadowFrame& frame, std::size_t v) const {
    const ShadowView& view = frame.views[v];
    const std::uint32_t every = frame.demands[view.demand].refresh_frames;
    return every > 1 && (frame_ + view.demand + view.layer) % every != 0 &&
           frame.slots[v].waited_frames < kMostWait_frames;
}

/// What keeping a layer that shows casters as they were would mean. Told only where it is known how far they moved
/// since, and the view itself stayed.
Staleness MapStore::staleness_of(const SceneSnapshot& scene, const ShadowFrame& frame, std::size_t v,
                                 const LightHistory& history) const {
    const ShadowView& view = frame.views[v];
    const ShadowSlot& slot = frame.slots[v];
    const bool certain = static_cast<bool>(slot.second);  // what sheets say would no longer be
    const bool economy = scene.lights[frame.demands[view.demand].light].tuning.reuse.economy;
    const bool shows_it = slot.shown_content != 0 && history.placements[view.layer] == slot.placement;
    if (certain || !economy || !shows_it || view.layer >= history.shown.size()) return kUnknownStaleness;
    return staleness(scene, view, history.shown[view.layer], slot.still_content, casters_of(frame, view));
}

/// Whether it is kept.
Hold MapStore::hold_of(const SceneSnapshot& scene, const ShadowFrame& frame, std::size_t v) const {
    const LightItem& light = scene.lights[frame.demands[frame.views[v].demand].light];
    const double error_px = frame.slots[v].if_held.error_px;
    if (!std::isfinite(error_px)) return Hold::none;
    if (may_be_held(light) && error_px <= static_cast<double>(light.shadow.refresh_error_px)) return Hold::within_error;
    return is_others_turn(frame, v) ? Hold::by_turn : Hold::none;
}

void MapStore::hold_views(const SceneSnapshot& scene, ShadowFrame& frame) const {
    join_cubes(frame);
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        ShadowSlot& slot = frame.slots[v];
        if (!slot.texture || slot.reuse) continue;
        const Hold hold = hold_of(scene, frame, v);
        slot.changed = hold != Hold::within_error && slot.shown_content != 0;
        if (hold != Hold::none) keep_layer(slot, hold);
    }
}

void MapStore::note_held(const SceneSnapshot& scene, ShadowFrame& frame) {
    share_offsets(frame);
    for (std::size_t v = 0; v < frame.views.size(); ++v)
        if (frame.slots[v].hold == Hold::by_turn)
            entry(scene.lights[frame.demands[frame.views[v].demand].light].entity).waits = true;
}

/// What a layer shows now that was just drawn, if it may have to be known how far that is from what is there later.
void MapStore::note_shown(const SceneSnapshot& scene, const ShadowFrame& frame, std::size_t v,
                          LightHistory& history) const {
    const ShadowView& view = frame.views[v];
    if (!may_be_held(scene.lights[frame.demands[view.demand].light]) && !takes_turns_) {
        history.shown.clear();
        return;
    }
    history.shown.resize(history.targets.size());
    remember(scene, casters_of(frame, view).subspan(view.still_casters), frame.slots[v].still_content,
             history.shown[view.layer]);
}

}  // namespace gnomon::shadow
