#include <algorithm>

#include "engine/core/signature.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/request/filter_table.h"

/// Assignment of maps (stage 5): where each view's map lies, and what its layer is to show.
namespace gnomon::shadow {
namespace {

/// Mark between static and moving casters: a draw ends there.
constexpr std::uint64_t kBoundary = ~std::uint64_t{0};

/// Adds the size of the source to a content hash, since the occluder pyramid depends on it.
std::uint64_t with_source(std::uint64_t content, const FilterSettings& filter) {
    Signature s;
    s.add(content);
    s.add(filter.source_radius_m);
    s.add(filter.sun_radius_tan);
    return s.value();
}

}  // namespace

ContentSignature content_signature(const ShadowView& view, std::uint32_t size_px, const SceneSnapshot& scene,
                                   std::span<const std::uint32_t> casters, std::span<const std::uint32_t> meshes,
                                   CasterFaces faces) {
    Signature s;
    s.add(std::uint64_t{size_px});
    s.add(static_cast<std::uint64_t>(faces));
    for (int i = 0; i < 3; ++i) s.add(view.pose.anchor_ws_m[i]);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) s.add(view.clip_from_anchor[column][row]);
    const std::uint64_t placement = s.value();
    const auto add = [&](std::size_t from, std::size_t end) {
        for (std::size_t c = from; c < end; ++c) {
            const InstanceItem& item = scene.instances[casters[c]];
            s.add(item.gpu_slot | item.mesh_version << 32);
            s.add(item.version);
            if (!meshes.empty()) s.add(std::uint64_t{meshes[c]});
        }
    };
    const std::size_t still = std::min<std::size_t>(view.static_casters, casters.size());
    add(0, still);
    const std::uint64_t of_still = s.value();
    if (still > 0 && still < casters.size()) s.add(kBoundary);
    add(still, casters.size());
    return {of_still, s.value(), placement};
}

void MapCache::assign(const SceneSnapshot& scene, const FittedViews& fitted, std::span<const BudgetDecision> decisions,
                      std::vector<MapAssignment>& maps, const LightAccounts& accounts) {
    provide_maps(scene, decisions, accounts);
    maps.assign(fitted.views.size(), {});
    for (std::size_t v = 0; v < fitted.views.size(); ++v) {
        const ShadowView& view = fitted.views[v];
        if (accounts.statuses[view.light].is_skipped()) continue;
        const LightTimer time(accounts.cpu_us, view.light);
        const LightItem& light = scene.lights[view.light];
        const CachedMap& cached = entry(light.entity);
        if (!cached.texture) continue;  // rays replace the map
        MapAssignment& map = maps[v];
        map.texture = cached.texture;
        map.target = cached.layers.targets[view.layer];
        map.triangles = cached.triangles;
        map.triangle_bits = cached.references.triangle_bits;
        if (cached.storage.conservative_bounds)
            map.sheets = {cached.sheets.second, cached.sheets.second_targets[view.layer], cached.sheets.bounds,
                          cached.sheets.bounds_targets[view.layer], cached.sheets.ends};
        if (cached.moments.texture)
            map.prefiltered = {cached.moments.texture, cached.moments.targets[view.layer], cached.moments.scratch,
                               cached.moments.scratch_target};
        map.size_px = cached.desc.width;
        map.content = content_signature(view, map.size_px, scene, fitted.casters_of(view), fitted.meshes_of(view),
                                        light.shadow.caster_faces);
        if (map.sheets.ends)
            map.content.all = with_source(map.content.all, decisions[view.light].request.map.filtering);
    }
}

}  // namespace gnomon::shadow
