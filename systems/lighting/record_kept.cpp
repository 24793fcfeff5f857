#include <algorithm>

#include "engine/core/signature.h"
#include "shaders/bindings.h"
#include "systems/lighting/lighting_system.h"

/// Cached visibility of lights: conditions, recording and report.
namespace gnomon::lighting {

/// Hashes all that surfaces show to lights: camera, drawn instances with place and pose, shadow layers.
std::uint64_t LightingSystem::surfaces_signature(const SceneSnapshot& scene) const {
    Signature s;
    s.add(std::as_bytes(std::span(&camera_, 1)));
    s.add(std::uint64_t{has_places_});
    for (const std::uint32_t i : visible_) {
        const InstanceItem& item = scene.instances[i];
        s.add((std::uint64_t{item.gpu_slot} << 32) | item.mesh);
        s.add(item.version);
        s.add(item.mesh_version);
        const std::uint64_t layers = item.receives ? item.receive_layers : 0u;
        s.add(layers * 4 + (item.winding.mirrored ? 2u : 0u) + (item.winding.folded ? 1u : 0u));
    }
    return s.value();
}

/// Plans the passes; runs after prepare(), so that programs can be made.
void LightingSystem::plan_passes(const shadow::LightingInputs& inputs, const SceneSnapshot& scene,
                                 const LightingSettings& settings) {
    const auto may_keep = [](const shadow::LightingLight& light) { return light.lookup_signature != 0; };
    const bool any = std::any_of(inputs.lights.begin(), inputs.lights.end(), may_keep);
    const std::uint64_t surfaces = any ? surfaces_signature(scene) : 0;
    kept_.begin(scene.consumers[inputs.consumer].entity, settings.most_kept_bytes);
    passes_.resize(inputs.lights.size());
    for (std::size_t i = 0; i < inputs.lights.size(); ++i) {
        const shadow::LightingLight& light = inputs.lights[i];
        if (light.area.screen.width > 0) passes_[i].own = light_program(light, ShaderPass::picture);
        if (!passes_[i].own.edges) continue;
        passes_[i].reads = passes_[i].own.edges.reads;
        passes_[i].read_area = viewport();
        passes_[i].source = edges_.shares();
    }
    // Programs that only save time come last.
    for (std::size_t i = 0; i < inputs.lights.size(); ++i) {
        const shadow::LightingLight& light = inputs.lights[i];
        if (light.area.screen.width > 0 && may_keep(light) && passes_[i].own.lacks == Reason::none)
            plan_kept(light, scene.lights[light.light].entity, surfaces, settings.noise_round, passes_[i]);
    }
    kept_.end();
}

/// Plans a light's cached visibility. Its programs are made when it is filled: for visibility alone, and for the
/// light's kind.
void LightingSystem::plan_kept(const shadow::LightingLight& light, ecs::Entity entity, std::uint64_t surfaces,
                               std::uint32_t noise_round, LightPass& pass) {
    Signature s;
    s.add(surfaces);
    s.add(light.lookup_signature);
    if (shadow::has_noise(light.record)) s.add(std::uint64_t{noise_round});
    const KeptVisibility::Plan plan = kept_.plan(entity, s.value(), light.area.screen, targets_.size_px());
    if (plan.use == KeptVisibility::Use::look_up) return;
    const bool fills = plan.use == KeptVisibility::Use::fill;
    // One after the other, because a frame may make only one.
    const auto made = [&](const shadow::ShaderKey& row, ShaderPass output) {
        return programs_.must_wait(row, output) ? gl::ProgramHandle{} : programs_.row(row, output);
    };
    const gl::ProgramHandle reads = made(kept_row(light.row), ShaderPass::kept);
    LightProgram visibility;
    if (fills && reads && made(light.row, ShaderPass::visibility))
        visibility = light_program(light, ShaderPass::visibility);
    const bool can_fill = visibility.program && visibility.lacks == Reason::none && !visibility.unshadowed;
    if (!reads || (fills && !can_fill)) return kept_.cancel(entity);
    pass.kept = plan;
    pass.reads = reads;
    pass.fills = visibility;
    pass.read_area = plan.area;
    pass.source = plan.texture;
}

void LightingSystem::bind_kept(const LightPass& pass, std::uint32_t index, gl::CommandList& list) const {
    list.add(gl::BindUniforms{bindings::kLightBlock, uniforms_.handle(), lights_offset_ + index * light_stride_,
                              sizeof(shadow::LightRecord)});
    list.add(gl::BindUniforms{bindings::kKeptBlock, uniforms_.handle(), kept_offset_ + index * kept_stride_,
                              sizeof(KeptRecord)});
    list.add(gl::BindTexture{bindings::kKeptVisibilityUnit, pass.source, point_sampler_});
}

void LightingSystem::record_kept(const LightPass& pass, std::uint32_t index, const shadow::LightingLight& light,
                                 gl::CommandList& list) const {
    list.add(gl::BeginPass{targets_.light_target, viewport(), false, 0.0f, false, {}});
    list.add(gl::SetScissor{light.area.screen});
    list.add(
        gl::SetPipeline{{pass.reads, gl::CullMode::none, false, gl::DepthTest::less, false, false, gl::Blend::add}});
    bind_surface_textures(list);
    bind_kept(pass, index, list);
    bind_tint(light.tint, list);
    list.add(gl::DrawTriangle{light.area.farthest_depth});
    list.add(gl::EndPass{});
}

/// Records the filling. Filters derive randomness from the pixel's place, so that a part is filled in a texture of the
/// picture's size.
void LightingSystem::record_fill(const LightPass& pass, std::uint32_t index, const GpuScene& gpu,
                                 gl::CommandList& list) {
    const KeptVisibility::Plan& kept = pass.kept;
    const LightProgram& fills = pass.fills;
    if (fills.edges) {
        record_edges(fills, index, kept.area, {}, gpu, list);
        list.add(gl::Blit{edges_.target(), kept.target, kept.area, {0, 0, kept.area.width, kept.area.height}});
        return;
    }
    if (fills.verdicts_program) record_rays(fills, index, {}, {}, gpu, list);
    list.add(gl::BeginPass{kept.scratch ? kept.scratch : kept.target, viewport(), false, 0.0f, false, {}});
    list.add(gl::SetScissor{kept.area});
    list.add(
        gl::SetPipeline{{fills.program, gl::CullMode::none, false, gl::DepthTest::off, false, false, gl::Blend::off}});
    bind_surface_textures(list);
    bind_light(fills, index, gpu, list);
    if (fills.verdicts_program) ray_list_.bind_answers(list);
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    if (fills.verdicts_program) ray_list_.unbind_answers(list);
    if (!kept.scratch) return;
    list.add(gl::Blit{kept.scratch, kept.target, kept.area, {0, 0, kept.area.width, kept.area.height}});
}

void LightingSystem::note_kept(const LightPass& pass, std::uint32_t index, const LightItem& light,
                               shadow::LightingOutcome& outcome) {
    const bool may_pay = light.has_shadow && light.tuning.reuse.keep_visibility && light.tuning.reuse.economy;
    if (may_pay && kept_.is_told() && !pass.fills.program) lookup_times_.add(index, light.entity, pass.is_kept());
    if (!pass.is_kept()) return;
    outcome.cached.push_back({index, pass.kept.bytes, !pass.fills.program, lookup_times_.saved_us(light.entity)});
}

void LightingSystem::submitted(std::uint64_t submission, bool drawn) {
    kept_.submitted(drawn);
    lookup_times_.submitted(submission);
}

}  // namespace gnomon::lighting
