#include "systems/shadow/publish/visibility_hash.h"

#include "engine/core/signature.h"

namespace gnomon::shadow {
namespace {

template <class T>
void add_object(const T& object, Signature& s) {
    s.add(std::as_bytes(std::span(&object, 1)));
}

void add_row(const ShaderKey& row, Signature& s) {
    for (const std::string_view text : {row.kind_define, row.kind_file, row.filter_file})
        s.add(std::as_bytes(std::span(text)));
    s.add(row.reach_texel);
    std::uint64_t bits = 0;
    for (const bool bit : {row.fades, row.depths, row.manual_bias, row.triangles, row.moments, row.rays, row.ray_masks,
                           row.footprint, row.sheets, row.whole_source})
        bits = bits * 2 + (bit ? 1 : 0);
    s.add(bits * 4 + static_cast<std::uint64_t>(row.area_shares));
}

/// Adds what the lookup reads, and where.
void add_light(const LightingLight& light, Signature& s) {
    LightRecord record = light.record;
    record.radiance = glm::vec4(0.0f, 0.0f, 0.0f, record.radiance.w);  // rgb scales light, visibility is unchanged
    add_object(record, s);
    add_row(light.row, s);
    for (const std::uint32_t id :
         {light.map.id, light.triangles.id, light.second.id, light.bounds.id, light.sampler.id})
        s.add(std::uint64_t{id});
    for (const gl::BufferHandle buffer :
         {light.rays.nodes, light.rays.triangles, light.rays.top, light.rays.instances, light.rays.masks})
        s.add(std::uint64_t{buffer.id});
    add_object(light.area.screen, s);
    s.add(light.area.farthest_depth);
}

/// Adds the content of the layers of the light's map. Returns false if they are stale, or if rays replace a map that
/// changes in every frame: a kept result would not last.
bool add_views(const DrawnViews& drawn, std::uint32_t light, Signature& s) {
    const IndexRange range = drawn.fitted.lights[light].views;
    for (std::size_t v = range.first; v < range.end(); ++v) {
        const UpdatePlan& plan = drawn.updates[v];
        if (plan.hold != Hold::none || plan.skipped_for_rays) return false;
        s.add(drawn.has_map(v) ? plan.content : 0);
        s.add(drawn.has_prefiltered(v) ? plan.moment_content : 0);
    }
    return true;
}

}  // namespace

void sign_lookups(const SceneSnapshot& scene, const DrawnViews& drawn, LightingInputs& inputs) {
    for (std::uint32_t i = 0; i < inputs.lights.size(); ++i) {
        LightingLight& light = inputs.lights[i];
        const ShadowTuning::Reuse& reuse = scene.lights[i].tuning.reuse;
        if (light.row.filter_file.empty() || !reuse.economy || !reuse.keep_visibility || scene.version == 0) continue;
        Signature s;
        add_light(light, s);
        // Rays meet casters anywhere.
        if (light.row.rays) s.add(scene.version);
        if (add_views(drawn, i, s)) light.lookup_signature = s.value();
    }
}

}  // namespace gnomon::shadow
