#include "systems/frame_timers.h"
#include "systems/lighting/lighting_system.h"

/// Which program evaluates a light, what it reads, and the pass that does.
namespace gnomon::lighting {

void LightingSystem::bind_rays(const visibility::RayBuffers& rays, const GpuScene& gpu, gl::CommandList& list) const {
    list.add(gl::BindTexture{6, targets_.places, point_sampler_});
    list.add(gl::BindStorage{0, gpu.instances()});
    std::uint32_t binding = 3;
    for (const gl::BufferHandle buffer : {rays.nodes, rays.triangles, rays.top, rays.instances, rays.masks})
        if (buffer) list.add(gl::BindStorage{binding++, buffer});
}

void LightingSystem::bind_light(const LightProgram& light, std::uint32_t index, const GpuScene& gpu,
                                gl::CommandList& list) const {
    list.add(
        gl::BindUniforms{1, uniforms_.handle(), lights_offset_ + index * light_stride_, sizeof(shadow::LightRecord)});
    if (light.map) list.add(gl::BindTexture{4, light.map, light.sampler});
    if (light.second) list.add(gl::BindTexture{7, light.second, {}});
    if (light.bounds) list.add(gl::BindTexture{8, light.bounds, {}});
    if (light.rays.nodes) bind_rays(light.rays, gpu, list);
    if (!light.triangles) return;
    list.add(gl::BindTexture{5, light.triangles, {}});
    list.add(gl::BindStorage{0, gpu.instances()});
    list.add(gl::BindStorage{2, gpu.caster_triangles()});
}

/// The light's own row; where that cannot be had, one tap of its map; or the same light without its shadow.
LightingSystem::LightProgram LightingSystem::light_program(const shadow::LightingLight& light, RowOutput output) {
    const shadow::PlainLookup& plain = light.plain;
    const bool has_plain = !plain.row.filter_file.empty() && !(plain.row == light.row);
    const bool may_wait = has_plain && output != RowOutput::visibility;  // that is asked for by itself
    Reason lacks = Reason::filter_program_waits;
    const bool has_surfaces = !light.row.rays || has_places_;
    if (!has_surfaces) lacks = Reason::buffer_failed;
    if (has_surfaces && (!may_wait || !programs_.must_wait(light.row, output))) {
        const gl::ProgramHandle own = programs_.row(light.row, output);
        if (own) return {own, light.map, light.triangles, light.second, light.bounds, light.sampler, light.rays};
        lacks = Reason::filter_program_failed;
    }
    const gl::ProgramHandle one_tap = has_plain ? programs_.row(plain.row, output) : gl::ProgramHandle{};
    if (one_tap) return {one_tap, plain.map, {}, {}, {}, plain.sampler, {}, lacks};
    shadow::ProgramRow unshadowed = light.row;
    unshadowed.filter_file = {};
    if (has_surfaces) lacks = Reason::lighting_program_failed;
    return {programs_.row(unshadowed, output), {}, {}, {}, {}, {}, {}, lacks, true};
}

void LightingSystem::record_lights(const shadow::LightingInputs& inputs, const SceneSnapshot& scene,
                                   const GpuScene& gpu, gl::CommandList& list, FrameReport& report) {
    list.add(gl::BeginGroup{"lights"});
    for (std::uint32_t i = 0; i < inputs.lights.size(); ++i) {
        const shadow::LightingLight& light = inputs.lights[i];
        if (light.screen.width <= 0) continue;
        const LightProgram used = light_program(light, RowOutput::picture);
        if (used.lacks != Reason::none) {
            report.lights[light.light].state = used.unshadowed ? LightState::skipped : LightState::degraded;
            report.lights[light.light].reason = used.lacks;
        }
        if (!used.program) continue;
        list.add(gl::BeginGroup{scene.lights[light.light].name});
        list.add(gl::BeginTimer{lighting_timer(light.light)});
        list.add(gl::BeginPass{targets_.light_target, viewport(), false, 0.0f, false, {}});
        list.add(gl::SetScissor{light.screen});
        list.add(gl::SetPipeline{
            {used.program, gl::CullMode::none, false, gl::DepthTest::less, false, false, gl::Blend::add}});
        bind_surface_textures(list);
        bind_light(used, i, gpu, list);
        list.add(gl::DrawTriangle{light.farthest_depth});
        list.add(gl::EndPass{});
        list.add(gl::EndTimer{lighting_timer(light.light)});
        list.add(gl::EndGroup{});
    }
    list.add(gl::EndGroup{});
}

}  // namespace gnomon::lighting
