#include "systems/shadow/update/static_caster_copy.h"

namespace gnomon::shadow {

bool pays_to_copy(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const std::uint32_t> static_casters,
                  std::uint64_t bytes) {
    std::uint64_t worth = 0;
    for (const std::uint32_t i : static_casters) {
        worth += gpu.mesh(scene.instances[i].mesh).triangles * kCopiedBytesPerTriangle;
        if (worth > bytes) return true;
    }
    return false;
}

void copy_static_casters(const SceneSnapshot& scene, const GpuScene& gpu, const UpdateInputs& inputs, MapCache& maps,
                         std::vector<UpdatePlan>& plans) {
    for (std::size_t v = 0; v < plans.size(); ++v) {
        const ShadowView& view = inputs.fitted.views[v];
        const MapAssignment& assigned = inputs.maps[v];
        UpdatePlan& plan = plans[v];
        const bool both = view.static_casters > 0 && view.static_casters < view.casters.count;
        if (!both || !assigned.texture || plan.skipped_for_rays || plan.reuse || plan.begun_by_engine ||
            assigned.sheets.second)
            continue;
        const LightItem& light = scene.lights[view.light];
        if (!light.tuning.reuse.economy) continue;
        CachedMap& map = maps.entry(light.entity);
        map.still.layers.resize(map.layers.targets.size());
        StaticCopy::Layer& layer = map.still.layers[view.layer];
        const bool present = layer.content == assigned.content.still;
        // Copies only what was shown twice. A fit that follows the camera, or an object that moves one step, may never
        // show it again.
        const bool again = layer.drawn == assigned.content.still;
        layer.drawn = assigned.content.still;
        if (!present && !again) continue;
        const auto still = inputs.fitted.static_casters_of(view);
        if (!pays_to_copy(scene, gpu, still, layer_bytes(map))) continue;
        if (!map.still.is_worth_room) map.still.is_worth_room = pays_to_copy(scene, gpu, still, kWorthRoom_bytes);
        if (!maps.provide_static_copy(map)) continue;
        plan.copy.use = present ? StaticCopyUse::copy : StaticCopyUse::fill;
        plan.copy.texture = map.still.texture;
        plan.copy.triangles = map.still.triangles;
        map.still.last_used_frame = maps.frame();
    }
    maps.release_idle_copies();
}

}  // namespace gnomon::shadow
