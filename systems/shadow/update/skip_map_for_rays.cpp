#include "systems/shadow/update/skip_map_for_rays.h"

#include "engine/core/signature.h"
#include "systems/shadow/request/ray_limit.h"

namespace gnomon::shadow {
namespace {

/// Costs of a conservative map, in rays: a caster's triangle, drawn three times and measured; a texel, cleared and
/// written as often; one pixel's classification. Ratios of one run (docs/results/exact.md).
constexpr double kTriangle_rays = 2.5, kTexel_rays = 0.1, kVerdict_rays = 0.15;

/// Returns a hash of what the views of the range show after this frame.
std::uint64_t content_of(const std::vector<UpdatePlan>& plans, IndexRange range) {
    Signature s;
    for (std::size_t v = range.first; v < range.end(); ++v) s.add(plans[v].content);
    return s.value();
}

BoundsLoad load_of(const SceneSnapshot& scene, const GpuScene& gpu, const UpdateInputs& inputs,
                   const std::vector<UpdatePlan>& plans, IndexRange range) {
    BoundsLoad load;
    for (std::size_t v = range.first; v < range.end(); ++v) {
        if (plans[v].reuse) continue;
        const double size_px = inputs.maps[v].size_px;
        load.texels += size_px * size_px;
        for (const std::uint32_t i : inputs.fitted.casters_of(inputs.fitted.views[v]))
            load.triangles += static_cast<double>(gpu.mesh(scene.instances[i].mesh).triangles);
    }
    return load;
}

}  // namespace

bool are_rays_cheaper(double pixels, double rays_per_pixel, const BoundsLoad& load) {
    const double drawn = load.triangles * kTriangle_rays + load.texels * kTexel_rays;
    return pixels * rays_per_pixel < drawn + pixels * (kVerdict_rays + kUncertainShare * rays_per_pixel);
}

void skip_maps_for_rays(const SceneSnapshot& scene, const GpuScene& gpu, const UpdateInputs& inputs, MapCache& maps,
                        std::vector<UpdatePlan>& plans) {
    if (scene.air.any) return;  // places in the air are looked up in maps
    for (std::uint32_t i = 0; i < inputs.fitted.lights.size(); ++i) {
        const IndexRange range = inputs.fitted.lights[i].views;
        const LightItem& light = scene.lights[i];
        const ShadowRequest& request = inputs.decisions[i].request;
        if (range.count == 0 || !request.rays.used || !light.tuning.reuse.economy || !inputs.maps[range.first].texture)
            continue;
        CachedMap& cached = maps.entry(light.entity);
        const std::uint64_t content = content_of(plans, range);
        const bool moves = cached.wanted_content != 0 && cached.wanted_content != content;
        cached.wanted_content = content;
        if (!moves || !are_rays_cheaper(lookup_pixels(scene, light), rays_per_pixel(request.map),
                                        load_of(scene, gpu, inputs, plans, range)))
            continue;
        for (std::size_t v = range.first; v < range.end(); ++v) {
            plans[v] = {};
            plans[v].skipped_for_rays = true;
        }
    }
}

}  // namespace gnomon::shadow
