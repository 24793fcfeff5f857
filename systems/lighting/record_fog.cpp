#include <algorithm>
#include <glm/geometric.hpp>

#include "engine/math/frustum.h"
#include "shaders/bindings.h"
#include "systems/extract/volumes.h"
#include "systems/lighting/lighting_system.h"

/// Fog over the finished picture: what it takes, and what each light adds to it.
namespace gnomon::lighting {

/// Collects the boxes of fog in the camera's view, the farthest first.
void LightingSystem::collect_fogs(const ConsumerItem& consumer, const SceneSnapshot& scene) {
    fogs_.clear();
    if (scene.air.fogs.empty()) return;
    const math::Frustum frustum = consumer_frustum(consumer);
    for (std::uint32_t i = 0; i < scene.air.fogs.size(); ++i)
        if (math::may_overlap(frustum, scene.instances[scene.air.fogs[i].instance].bounds_ws)) fogs_.push_back(i);
    const auto distance_m = [&](std::uint32_t i) {
        return glm::distance(scene.instances[scene.air.fogs[i].instance].translation_ws_m, consumer.position_ws_m);
    };
    std::sort(fogs_.begin(), fogs_.end(), [&](std::uint32_t a, std::uint32_t b) {
        const double a_m = distance_m(a), b_m = distance_m(b);
        return a_m != b_m ? a_m > b_m : a < b;
    });
}

/// Returns a light's program over fog. A light with rays is looked up in its map by one tap where it has one, because
/// each pixel has many places.
LightProgram LightingSystem::fog_program(const shadow::LightingLight& light) {
    const bool by_tap = light.row.rays && light.plain.map;
    shadow::ShaderKey row = by_tap ? light.plain.row : light.row;
    row.area_shares = shadow::AreaShares::none;
    row.tint = light.row.tint;
    if (programs_.must_wait(row, ShaderPass::fog))
        return fallback_program(programs_, light, ShaderPass::fog, Reason::filter_program_waits);
    const gl::ProgramHandle program = programs_.row(row, ShaderPass::fog);
    if (!program) return fallback_program(programs_, light, ShaderPass::fog, Reason::filter_program_failed);
    if (by_tap) return {.program = program, .map = light.plain.map, .sampler = light.plain.sampler, .tint = light.tint};
    return {program,      light.map,    light.triangles, light.sampler, light.rays,
            light.second, light.bounds, light.ends,      light.tint};
}

/// Records the boxes of fog, each over what is behind it: surfaces, and farther boxes.
void LightingSystem::record_fogs(const shadow::LightingInputs& inputs, const GpuScene& gpu, gl::CommandList& list,
                                 shadow::LightingOutcome& outcome) {
    const gl::ProgramHandle base = fogs_.empty() ? gl::ProgramHandle{} : programs_.fog_base();
    if (!base) return;
    forward_programs_.clear();
    for (const shadow::LightingLight& light : inputs.lights) {
        LightProgram& used = forward_programs_.emplace_back();
        if (light.area.screen.width <= 0) continue;
        used = fog_program(light);
        if (used.lacks != Reason::none)
            outcome.failures.push_back({light.light, used.lacks, used.unshadowed, true, light.plain.accuracy});
    }
    list.add(gl::BeginGroup{"fog"});
    list.add(gl::BeginPass{targets_.light_target, viewport(), false, 0.0f, false, {}});
    for (std::uint32_t f = 0; f < fogs_.size(); ++f) {
        list.add(gl::SetScissor{viewport()});
        list.add(
            gl::SetPipeline{{base, gl::CullMode::none, false, gl::DepthTest::off, false, false, gl::Blend::alpha}});
        bind_surface_textures(list);
        list.add(gl::BindUniforms{bindings::kAmbientBlock, uniforms_.handle(), ambient_offset_, sizeof(AmbientRecord)});
        list.add(gl::BindUniforms{bindings::kFogBlock, uniforms_.handle(), fogs_offset_ + f * fog_stride_,
                                  sizeof(FogRecord)});
        list.add(gl::DrawTriangle{});
        for (std::uint32_t i = 0; i < inputs.lights.size(); ++i) {
            const LightProgram& used = forward_programs_[i];
            if (!used.program) continue;
            list.add(gl::SetScissor{inputs.lights[i].area.screen});
            list.add(gl::SetPipeline{
                {used.program, gl::CullMode::none, false, gl::DepthTest::off, false, false, gl::Blend::add}});
            bind_light(used, i, gpu, list);
            list.add(gl::DrawTriangle{});
        }
    }
    list.add(gl::EndPass{});
    list.add(gl::EndGroup{});
}

}  // namespace gnomon::lighting
