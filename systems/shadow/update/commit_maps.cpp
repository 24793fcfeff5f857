#include "systems/shadow/update/commit_maps.h"

#include "systems/shadow/update/keep_stale_maps.h"
#include "systems/shadow/update/stale_error.h"

namespace gnomon::shadow {
namespace {

/// Records the casters that a layer just drawn shows, if its map may be kept when they move.
void note_shown(const SceneSnapshot& scene, const DrawnViews& drawn, std::size_t v, bool takes_turns,
                CachedMap& cached) {
    const ShadowView& view = drawn.view(v);
    if (!may_be_held(scene.lights[view.light]) && !takes_turns) {
        cached.layers.shown.clear();
        return;
    }
    cached.layers.shown.resize(cached.layers.targets.size());
    remember(scene, drawn.fitted.moving_casters_of(view), drawn.maps[v].content.still, cached.layers.shown[view.layer]);
    cached.layers.shown[view.layer].proxy_m = view.error.proxy_m;
}

}  // namespace

void commit_maps(const SceneSnapshot& scene, const DrawnViews& drawn, const FrameEnd& end, MapCache& maps) {
    for (std::size_t v = 0; v < drawn.count(); ++v) {
        if (!drawn.has_map(v)) continue;
        const std::uint32_t layer = drawn.view(v).layer;
        const UpdatePlan& plan = drawn.updates[v];
        const ContentSignature& wanted = drawn.maps[v].content;
        CachedMap& cached = maps.entry(scene.lights[drawn.view(v).light].entity);
        if (!plan.reuse) {
            cached.layers.content[layer] = end.executed ? plan.content : 0;
            cached.layers.placements[layer] = wanted.placement;
            note_shown(scene, drawn, v, end.takes_turns, cached);
        }
        if (layer < cached.layers.shown.size())
            cached.layers.shown[layer].waited_frames = plan.hold == Hold::by_turn ? plan.waited_frames + 1 : 0;
        if (plan.copy.use == StaticCopyUse::fill) cached.still.layers[layer].content = end.executed ? wanted.still : 0;
        if (plan.convert && drawn.has_prefiltered(v))
            cached.moments.content[layer] = end.executed ? plan.moment_content : 0;
    }
}

}  // namespace gnomon::shadow
