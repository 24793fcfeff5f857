#include "shaders/bindings.h"
#include "systems/frame_timers.h"
#include "systems/lighting/lighting_system.h"

/// Choice of a light's program, its inputs, and its pass.
namespace gnomon::lighting {

void LightingSystem::bind_rays(const visibility::RayBuffers& rays, const GpuScene& gpu, gl::CommandList& list) const {
    list.add(gl::BindTexture{bindings::kSurfacePlaceUnit, targets_.places, point_sampler_});
    list.add(gl::BindTexels{bindings::kInstanceUnit, gpu.instances()});
    list.add(gl::BindTexels{bindings::kTriangleNormalUnit, gpu.triangle_normals()});
    list.add(gl::BindTexels{bindings::kVertexUnit, gpu.vertices()});
    list.add(gl::BindTexels{bindings::kRayNodeUnit, rays.nodes});
    list.add(gl::BindTexels{bindings::kRayTriangleUnit, rays.triangles});
    list.add(gl::BindTexels{bindings::kRayTopUnit, rays.top});
    list.add(gl::BindTexels{bindings::kRayInstanceUnit, rays.instances});
    if (rays.masks) list.add(gl::BindStorage{bindings::kMaskBuffer, rays.masks});
}

void LightingSystem::bind_light(const LightProgram& light, std::uint32_t index, const GpuScene& gpu,
                                gl::CommandList& list) const {
    list.add(gl::BindUniforms{bindings::kLightBlock, uniforms_.handle(), lights_offset_ + index * light_stride_,
                              sizeof(shadow::LightRecord)});
    bind_maps(light, list);
    if (light.rays.nodes) bind_rays(light.rays, gpu, list);
    bind_triangles(light, gpu, list);
}

/// Chooses the program: the light's own row, otherwise one tap of its map, otherwise the light without shadow.
LightProgram LightingSystem::light_program(const shadow::LightingLight& light, ShaderPass output) {
    const shadow::FallbackLookup& plain = light.plain;
    const bool has_plain = !plain.row.filter_file.empty() && !(plain.row == light.row);
    // An explicitly requested visibility is never deferred.
    const bool may_wait = has_plain && output != ShaderPass::visibility;
    Reason lacks = Reason::buffer_failed;
    const bool lists = light.row.sheets && !is_forward(output);
    const bool has_surfaces = !light.row.rays || (has_places_ && (!lists || ray_list_));
    if (has_surfaces) {
        bool waits = false;
        // Each program counts, because a frame may have time for only one.
        const auto made_of = [&](const shadow::ShaderKey& row, ShaderPass part) {
            const bool late = waits || (may_wait && programs_.must_wait(row, part));
            waits = late;
            return late ? gl::ProgramHandle{} : programs_.row(row, part);
        };
        const auto made = [&](ShaderPass part) { return made_of(light.row, part); };
        LightProgram used{{},           light.map,    light.triangles, light.sampler, light.rays,
                          light.second, light.bounds, light.ends,      light.tint};
        // Makes the programs of a list of rays, where the light has one.
        const auto finds_rays = [&] {
            if (!lists) return true;
            used.verdicts_program = made(ShaderPass::verdicts);
            used.rays_program = made(ShaderPass::rays);
            return used.verdicts_program && used.rays_program;
        };
        if (light.row.area_shares == shadow::AreaShares::marked && !is_forward(output) && edges_.is_there()) {
            shadow::ShaderKey middles = light.row;
            middles.area_shares = shadow::AreaShares::none;
            const ShaderPass reads = output == ShaderPass::picture ? ShaderPass::kept : ShaderPass::kept_visibility;
            if (!light.row.rays) used.decided_program = made_of(middles, ShaderPass::decided_middles);
            used.program = made_of(middles, light.row.rays ? ShaderPass::found_middles : ShaderPass::undecided_middles);
            used.edges = {programs_.mark_edges(), made(ShaderPass::crossed_areas), made_of(kept_row(light.row), reads)};
            if ((used.decided_program || light.row.rays) && used.program && used.edges && finds_rays()) return used;
            used.decided_program = {};
            used.edges = {};
        }
        used.program = made(output);
        // A program that only saves time is made when there is time.
        const bool leaves = !waits && light.row.triangles && light.row.area_shares != shadow::AreaShares::marked &&
                            output == ShaderPass::picture && targets_.undecided_target;
        if (leaves && !programs_.must_wait(light.row, ShaderPass::decided))
            used.decided_program = programs_.row(light.row, ShaderPass::decided);
        if (used.program && finds_rays()) return used;
        lacks = waits ? Reason::filter_program_waits : Reason::filter_program_failed;
    }
    LightProgram used = fallback_program(programs_, light, output, lacks);
    if (used.unshadowed && has_surfaces) used.lacks = Reason::lighting_program_failed;
    return used;
}

/// Records the passes before a light with a map of sheets: verdicts, and rays for undecided pixels, in that area.
/// `depth`: only surfaces before it, if given.
void LightingSystem::record_rays(const LightProgram& light, std::uint32_t index, const gl::Rect& area,
                                 std::optional<float> depth, const GpuScene& gpu, gl::CommandList& list) const {
    ray_list_.begin_verdicts(list);
    list.add(gl::SetScissor{area});
    list.add(gl::SetPipeline{
        {light.verdicts_program, gl::CullMode::none, false, gl::DepthTest::less, false, false, gl::Blend::off}});
    bind_surface_textures(list);
    bind_light(light, index, gpu, list);
    list.add(gl::DrawTriangle{depth});
    ray_list_.end_verdicts(list);
    ray_list_.record_rays(light.rays_program, list);
}

/// Records a light's draw over its area of the picture. If some pixels are slow there are two draws. The first removes
/// the depth of finished pixels, so that only the others pass the second one's depth test.
void LightingSystem::record_look_up(const LightProgram& light, std::uint32_t index, const gl::Rect& area,
                                    std::optional<float> depth, const GpuScene& gpu, gl::CommandList& list) const {
    const bool two = static_cast<bool>(light.decided_program);
    if (two) list.add(gl::CopyTexture{targets_.depth, targets_.undecided, 0, area});
    list.add(
        gl::BeginPass{two ? targets_.undecided_target : targets_.light_target, viewport(), false, 0.0f, false, {}});
    list.add(gl::SetScissor{area});
    const auto draw = [&](gl::ProgramHandle program, bool takes_depth) {
        list.add(gl::SetPipeline{
            {program, gl::CullMode::none, false, gl::DepthTest::less, takes_depth, false, gl::Blend::add}});
        bind_surface_textures(list);
        bind_light(light, index, gpu, list);
        if (light.verdicts_program) ray_list_.bind_answers(list);
        list.add(gl::DrawTriangle{depth});
    };
    if (two) draw(light.decided_program, true);
    draw(light.program, false);
    list.add(gl::EndPass{});
    if (light.verdicts_program) ray_list_.unbind_answers(list);
}

/// Records a light's visibility into the pass of edges.
void LightingSystem::record_edges(const LightProgram& light, std::uint32_t index, const gl::Rect& area,
                                  std::optional<float> depth, const GpuScene& gpu, gl::CommandList& list) const {
    const auto bind_inputs = [&] {
        bind_surface_textures(list);
        bind_light(light, index, gpu, list);
        if (light.verdicts_program) ray_list_.bind_answers(list);
    };
    if (light.verdicts_program) record_rays(light, index, area, depth, gpu, list);
    edges_.record(light, {targets_.depth, area, depth}, point_sampler_, bind_inputs, list);
    if (light.verdicts_program) ray_list_.unbind_answers(list);
}

void LightingSystem::record_lights(const shadow::LightingInputs& inputs, const SceneSnapshot& scene,
                                   const GpuScene& gpu, gl::CommandList& list, shadow::LightingOutcome& outcome) {
    list.add(gl::BeginGroup{"lights"});
    for (std::uint32_t i = 0; i < inputs.lights.size(); ++i) {
        const shadow::LightingLight& light = inputs.lights[i];
        if (light.area.screen.width <= 0) continue;
        const LightPass& pass = passes_[i];
        const LightProgram& used = pass.own;
        if (used.lacks != Reason::none)
            outcome.failures.push_back({light.light, used.lacks, used.unshadowed, false, light.plain.accuracy});
        if (!used.program) continue;
        list.add(gl::BeginGroup{scene.lights[light.light].name});
        list.add(gl::BeginTimer{lighting_timer(light.light)});
        if (pass.is_kept()) {
            if (pass.fills.program) record_fill(pass, i, gpu, list);
            record_kept(pass, i, light, list);
        } else if (pass.reads) {
            record_edges(used, i, light.area.screen, light.area.farthest_depth, gpu, list);
            record_kept(pass, i, light, list);
        } else {
            if (used.verdicts_program) record_rays(used, i, light.area.screen, light.area.farthest_depth, gpu, list);
            record_look_up(used, i, light.area.screen, light.area.farthest_depth, gpu, list);
        }
        list.add(gl::EndTimer{lighting_timer(light.light)});
        list.add(gl::EndGroup{});
        note_kept(pass, light.light, scene.lights[light.light], outcome);
    }
    list.add(gl::EndGroup{});
}

}  // namespace gnomon::lighting
