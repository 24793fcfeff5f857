#include "systems/shadow/update/static_caster_copy.h"

#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/maps/static_copy.h"

namespace gnomon::shadow {
namespace {

/// Of one layer, with its triangles.
std::uint64_t copied_bytes(const LightHistory& map) {
    std::uint64_t texel = gl::texel_bytes(map.desc.format);
    if (map.triangles) texel += gl::texel_bytes(kTriangleFormat);
    return texel * map.desc.width * map.desc.height;
}

}  // namespace

std::uint64_t still_bytes(const LightHistory& map) { return copied_bytes(map) * gl::layer_count(map.desc); }

bool pays_to_copy(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const std::uint32_t> still_casters,
                  std::uint64_t bytes) {
    std::uint64_t worth = 0;
    for (const std::uint32_t i : still_casters) {
        worth += gpu.mesh(scene.instances[i].mesh).triangles * kCopiedBytesPerTriangle;
        if (worth > bytes) return true;
    }
    return false;
}

void MapStore::release_still(StillMap& still) const {
    device_.destroy(still.texture);
    device_.destroy(still.triangles);
    still.texture = still.triangles = {};
    for (StillMap::Layer& layer : still.layers) layer.content = 0;
}

/// Nobody misses it if the device, or the budget, has no room: all is drawn, as without it.
bool MapStore::provide_still(LightHistory& map) const {
    StillMap& still = map.still;
    if (still.texture) return true;
    if (frame_ < still.retry_frame) return false;
    gl::TextureDesc desc = map.desc;
    desc.label += ", still";
    const bool fits = limit_ == kNoLimit || bytes() + still_bytes(map) <= limit_;
    if (fits) yield_spare(still_bytes(map));
    if (fits) still.texture = device_.create_texture(desc, {}).handle;
    desc.label += " triangles";
    desc.format = kTriangleFormat;
    if (still.texture && map.triangles) still.triangles = device_.create_texture(desc, {}).handle;
    if (still.texture && static_cast<bool>(still.triangles) == static_cast<bool>(map.triangles)) return true;
    release_still(still);
    still.retry_frame = frame_ + kRetryFrames;
    return false;
}

void MapStore::keep_still_apart(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame) {
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        const ShadowView& view = frame.views[v];
        ShadowSlot& slot = frame.slots[v];
        const bool both = view.still_casters > 0 && view.still_casters < view.casters.count;
        if (!both || !slot.texture || slot.reuse || slot.second) continue;
        const ShadowDemand& demand = frame.demands[view.demand];
        const LightItem& light = scene.lights[demand.light];
        if (!light.tuning.reuse.economy) continue;
        const LightTime time(frame, demand.light);
        LightHistory& map = entry(light.entity);
        map.still.layers.resize(map.targets.size());
        StillMap::Layer& layer = map.still.layers[view.layer];
        const bool held = layer.content == slot.still_content;
        // What is seen once may never come again: a fit may follow the camera, or something moves but one step.
        const bool again = layer.drawn == slot.still_content;
        layer.drawn = slot.still_content;
        if (!held && !again) continue;
        const auto still = std::span(frame.view_caster_items).subspan(view.casters.first, view.still_casters);
        if (!pays_to_copy(scene, gpu, still, copied_bytes(map)) || !provide_still(map)) continue;
        slot.still_use = held ? StillUse::copy : StillUse::fill;
        slot.still = map.still.texture;
        slot.still_triangles = map.still.triangles;
        map.still.last_used_frame = frame_;
    }
    for (LightHistory& map : lights_)
        if (is_still_idle(map)) release_still(map.still);
}

bool MapStore::is_still_idle(const LightHistory& map) const {
    return map.still.texture && frame_ - map.still.last_used_frame > kHoldFrames;
}

}  // namespace gnomon::shadow
