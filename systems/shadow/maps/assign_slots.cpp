#include <algorithm>

#include "engine/core/signature.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/maps/cube_layering.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/request/filter_table.h"

/// The half of stage 5 that says what each view's layer is to hold, and whether it does.
namespace gnomon::shadow {
namespace {

/// Between casters that stand still and those that move: where a draw may not go on.
constexpr std::uint64_t kBoundary = ~std::uint64_t{0};

/// OpenGL's table has them side by side.
bool are_opposite_faces(std::uint32_t a, std::uint32_t b) { return a != b && a / 2 == b / 2; }

/// What is made of a map for a source with a size follows from that as well.
std::uint64_t with_source(std::uint64_t content, const FilterDemand& filter) {
    Signature s;
    s.add(content);
    s.add(filter.source_radius_m);
    s.add(filter.sun_radius_tan);
    return s.value();
}

}  // namespace

ContentSignature content_signature(const ShadowView& view, std::uint32_t size_px, const SceneSnapshot& scene,
                                   std::span<const std::uint32_t> casters, CasterFaces faces) {
    Signature s;
    s.add(std::uint64_t{size_px});
    s.add(static_cast<std::uint64_t>(faces));
    for (int i = 0; i < 3; ++i) s.add(view.anchor_ws_m[i]);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) s.add(view.clip_from_anchor[column][row]);
    const std::uint64_t placement = s.value();
    const auto add = [&](std::span<const std::uint32_t> group) {
        for (const std::uint32_t i : group) {
            s.add(std::uint64_t{scene.instances[i].gpu_slot});
            s.add(scene.instances[i].version);
        }
    };
    const std::size_t still = std::min<std::size_t>(view.still_casters, casters.size());
    add(casters.first(still));
    const std::uint64_t of_still = s.value();
    if (still > 0 && still < casters.size()) s.add(kBoundary);
    add(casters.subspan(still));
    return {of_still, s.value(), placement};
}

void MapStore::assign_views(const SceneSnapshot& scene, ShadowFrame& frame) {
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        const ShadowView& view = frame.views[v];
        if (frame.sets[view.demand].skip != Reason::none) continue;
        const LightTime time(frame, frame.demands[view.demand].light);
        const LightItem& light = scene.lights[frame.demands[view.demand].light];
        LightHistory& history = entry(light.entity);
        if (!history.texture) continue;  // rays do without
        ShadowSlot& slot = frame.slots[v];
        slot.texture = history.texture;
        slot.triangles = history.triangles;
        if (has_sheets(history.storage)) {
            slot.second = history.sheets.second;
            slot.second_target = history.sheets.second_targets[view.layer];
            slot.bounds = history.sheets.bounds;
            slot.bounds_target = history.sheets.bounds_targets[view.layer];
            slot.ends = history.sheets.ends;
        }
        slot.target = history.targets[view.layer];
        slot.size_px = history.desc.width;
        const ContentSignature signature =
            content_signature(view, slot.size_px, scene, casters_of(frame, view), light.shadow.caster_faces);
        slot.content = slot.ends ? with_source(signature.all, frame.demands[view.demand].filtering) : signature.all;
        slot.placement = signature.placement;
        slot.still_content = signature.still;
        slot.reuse = view.lit || (light.tuning.reuse.economy && history.content[view.layer] == slot.content);
        if (slot.reuse) continue;
        slot.shown_content = history.content[view.layer];
        slot.if_held = staleness_of(scene, frame, v, history);
        if (view.layer < history.shown.size()) slot.waited_frames = history.shown[view.layer].waited_frames;
    }
}

/// A view's moments follow from its own depths and, of a cube, those of the faces beside it.
void MapStore::assign_moments(const SceneSnapshot& scene, ShadowFrame& frame) {
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        const ShadowView& view = frame.views[v];
        const ShadowDemand& demand = frame.demands[view.demand];
        ShadowSlot& slot = frame.slots[v];
        if (!slot.texture || filter_row(demand.filter).storage != FilterStorage::moments) continue;
        const LightItem& light = scene.lights[demand.light];
        const MomentMap& moments = find(light.entity)->moments;
        slot.moments = moments.texture;
        slot.moment_target = moments.targets[view.layer];
        slot.scratch = moments.scratch;
        slot.scratch_target = moments.scratch_target;
        Signature s;
        s.add(static_cast<std::uint64_t>(demand.filter));
        s.add(std::uint64_t{demand.filtering.size});
        s.add(demand.moments.settings.x);
        s.add(demand.moments.settings.y);
        for (std::size_t other = 0; other < frame.views.size(); ++other) {
            if (frame.views[other].demand != view.demand) continue;
            const bool beside = view.projection == ViewProjection::cube_face &&
                                !are_opposite_faces(frame.views[other].layer, view.layer);
            if (other != v && !beside) continue;
            s.add(std::uint64_t{frame.views[other].layer});
            s.add(frame.slots[other].content);
        }
        slot.moment_content = s.value();
        slot.convert = !view.lit && (!light.tuning.reuse.economy || moments.content[view.layer] != slot.moment_content);
    }
}

void MapStore::choose_routes(const SceneSnapshot& scene, ShadowFrame& frame) {
    const auto drawn = [&](std::size_t v) { return frame.slots[v].texture && !frame.slots[v].reuse; };
    for (std::size_t first = 0, end = 0; first < frame.views.size(); first = end) {
        std::uint32_t faces = 0;
        bool apart = false;
        for (end = first; end < frame.views.size() && frame.views[end].demand == frame.views[first].demand; ++end) {
            faces += drawn(end) ? 1 : 0;
            apart = apart || frame.slots[end].still_use != StillUse::none;
        }
        // A map of sheets is peeled face by face.
        apart = apart || static_cast<bool>(frame.slots[first].second);
        if (frame.views[first].projection != ViewProjection::cube_face || faces == 0 || apart) continue;
        const LightItem& light = scene.lights[frame.demands[frame.views[first].demand].light];
        const CubeRoute route = cube_route(light.tuning.maps.cube_route, device_.info(), faces);
        if (route == CubeRoute::six_passes) continue;
        LightHistory& history = entry(light.entity);
        if (!history.whole) history.whole = device_.create_target(target_of(history, gl::kAllLayers)).handle;
        for (std::size_t v = first; v < end; ++v)
            if (drawn(v) && history.whole) {
                frame.slots[v].whole = history.whole;
                frame.slots[v].route = route;
            }
    }
}

void MapStore::commit(const SceneSnapshot& scene, const ShadowFrame& frame, bool drawn) {
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        const ShadowSlot& slot = frame.slots[v];
        if (!slot.texture) continue;
        const ShadowView& view = frame.views[v];
        LightHistory& history = entry(scene.lights[frame.demands[view.demand].light].entity);
        if (!slot.reuse) history.content[view.layer] = drawn ? slot.content : 0;
        if (!slot.reuse) history.placements[view.layer] = slot.placement;
        if (!slot.reuse) note_shown(scene, frame, v, history);
        if (view.layer < history.shown.size())
            history.shown[view.layer].waited_frames = slot.hold == Hold::by_turn ? slot.waited_frames + 1 : 0;
        if (slot.still_use == StillUse::fill) history.still.layers[view.layer].content = drawn ? slot.still_content : 0;
        if (slot.convert) history.moments.content[view.layer] = drawn ? slot.moment_content : 0;
    }
}

}  // namespace gnomon::shadow
