#include "engine/core/signature.h"
#include "systems/shadow/budget/ray_budget.h"
#include "systems/shadow/maps/map_cache.h"

/// The part of stage 5 that asks whether a map is worth drawing.
namespace gnomon::shadow {
namespace {

/// What the views [first, end) are to hold.
std::uint64_t content_of(const ShadowFrame& frame, std::size_t first, std::size_t end) {
    Signature s;
    for (std::size_t v = first; v < end; ++v) s.add(frame.slots[v].content);
    return s.value();
}

SheetLoad load_of(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame, std::size_t first,
                  std::size_t end) {
    SheetLoad load;
    for (std::size_t v = first; v < end; ++v) {
        if (frame.slots[v].reuse) continue;
        load.texels += static_cast<double>(frame.slots[v].size_px) * static_cast<double>(frame.slots[v].size_px);
        for (const std::uint32_t i : casters_of(frame, frame.views[v]))
            load.triangles += static_cast<double>(gpu.mesh(scene.instances[i].mesh).triangles);
    }
    return load;
}

}  // namespace

void MapStore::leave_to_rays(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame) {
    for (std::size_t first = 0, end = 0; first < frame.views.size(); first = end) {
        while (end < frame.views.size() && frame.views[end].demand == frame.views[first].demand) ++end;
        ShadowDemand& demand = frame.demands[frame.views[first].demand];
        const LightItem& light = scene.lights[demand.light];
        if (!demand.asks_rays || !light.tuning.reuse.economy || !frame.slots[first].texture) continue;
        LightHistory& history = entry(light.entity);
        const std::uint64_t content = content_of(frame, first, end);
        const bool moves = history.wanted_content != 0 && history.wanted_content != content;
        history.wanted_content = content;
        if (!moves || !are_rays_cheaper(asking_pixels(scene, light), rays_per_pixel(demand),
                                        load_of(scene, gpu, frame, first, end)))
            continue;
        demand.left_to_rays = true;
        for (std::size_t v = first; v < end; ++v) frame.slots[v] = {};
    }
}

}  // namespace gnomon::shadow
