#include "bench/embed/embed_client.h"

#include "systems/extract/light_facts.h"

namespace gnomon::bench {
namespace {

LightDesc desc_of(const PlacedLight& light) {
    return {.light = light.light, .position_m = light.position_m, .direction = light.direction, .shadow = light.shadow};
}

/// Returns units and bindings beside those of the engine's own shader, and the parts that the text needs.
LookupOptions lookup_options(const std::optional<EmbedCase>& only) {
    LookupOptions options{.first_texture_unit = 3, .texture_unit_count = 12, .storage_binding = 3};
    if (!only) return options;
    options.suns = options.spots = options.points = false;
    options.*only->part = true;
    options.filters = {only->filter};
    return options;
}

}  // namespace

std::vector<HostLight> host_lights(const std::vector<PlacedLight>& lights, const HostCamera& camera) {
    std::vector<HostLight> host;
    const glm::dvec3 camera_m(camera.world_from_view[3]);
    for (const PlacedLight& light : lights) {
        const bool is_sun = light_facts(light.light.kind).parallel;
        const glm::dvec3 way = is_sun ? -light.direction : light.position_m - camera_m;
        host.push_back({glm::vec4(way, is_sun ? 0.0 : 1.0), static_cast<int>(host.size())});
    }
    return host;
}

std::optional<Error> EmbedClient::make(const HostScene& scene, const std::optional<EmbedCase>& only) {
    ShadowsOptions options;
    if (way_ == HostShadows::lookup) options.lookup = lookup_options(only);
    auto made = Shadows::create(options);
    if (!made) return made.error();
    shadows_ = std::move(made).value();
    std::vector<MeshId> meshes;
    for (const HostMesh& mesh : scene.meshes) {
        const auto added = shadows_->add_mesh({.name = mesh.name,
                                               .positions_m = mesh.positions_m,
                                               .indices = mesh.indices,
                                               .two_sided = mesh.two_sided,
                                               .mask = {mesh.mask_px, mesh.alpha, mesh.cutoff},
                                               .uvs = mesh.uvs});
        if (!added) return added.error();
        meshes.push_back(added.value());
    }
    for (const HostPart& part : scene.parts)
        shadows_->add_caster({.mesh = meshes[part.mesh],
                              .world_from_mesh = part.world_from_mesh,
                              .casts = part.casts,
                              .receives = part.receives});
    std::string text;
    if (way_ == HostShadows::lookup) {
        const auto lookups = shadows_->lookup_glsl();
        if (!lookups) return lookups.error();
        text = lookups.value();
    }
    const auto shader = engine_.make_shader(way_, text);
    if (!shader) return shader.error();
    shader_ = shader.value();
    return std::nullopt;
}

void EmbedClient::put_lights(const std::vector<PlacedLight>& lights) {
    for (const LightId handle : handles_) shadows_->remove(handle);
    handles_.clear();
    for (const PlacedLight& light : lights) {
        handles_.push_back(shadows_->add_light(desc_of(light)));
        shadows_->tune(handles_.back(), light.tuning);
    }
    lights_ = lights;
}

void EmbedClient::move_lights(const std::vector<PlacedLight>& lights) {
    for (std::size_t i = 0; i < lights.size(); ++i) shadows_->set_light(handles_[i], desc_of(lights[i]));
    lights_ = lights;
}

void EmbedClient::render(const HostCamera& camera) {
    const bool wants_mask = way_ == HostShadows::mask;
    mask_ = shadows_
                ->render({.world_from_view = camera.world_from_view,
                          .clip_from_view = camera.clip_from_view,
                          .clip_depth = ClipDepth::zero_to_one,
                          .depth_texture = engine_.depth_texture(),
                          .size_px = engine_.size_px(),
                          .normal_texture = engine_.normal_texture(),
                          .lights = handles_,
                          .wants_mask = wants_mask,
                          .shows_only_added = true})
                .texture;
}

void EmbedClient::light(const HostCamera& camera) const {
    std::vector<HostLight> lights = host_lights(lights_, camera);
    if (way_ == HostShadows::lookup) {
        shadows_->bind_lookup();
        for (std::size_t i = 0; i < lights.size(); ++i) lights[i].index = shadows_->lookup_index(handles_[i]);
    }
    engine_.draw_lights(shader_, camera, lights, mask_);
}

}  // namespace gnomon::bench
