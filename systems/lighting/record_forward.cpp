#include "shaders/bindings.h"
#include "systems/lighting/lighting_system.h"

/// Surfaces that are drawn mesh by mesh after the lights' passes: shadow catchers, then blended surfaces.
namespace gnomon::lighting {

/// Looks up each light's program for what is drawn forward. Notes the lights that fall back.
void LightingSystem::plan_forward(const shadow::LightingInputs& inputs, ShaderPass output,
                                  shadow::LightingOutcome& outcome) {
    forward_programs_.clear();
    for (const shadow::LightingLight& light : inputs.lights) {
        LightProgram& used = forward_programs_.emplace_back();
        if (light.area.screen.width <= 0) continue;
        used = light_program(light, output);
        if (used.lacks != Reason::none)
            outcome.failures.push_back({light.light, used.lacks, used.unshadowed, true, light.plain.accuracy});
    }
}

void LightingSystem::add_catcher(const InstanceItem& item, const GpuScene& gpu) {
    const GpuScene::MeshRange& mesh = gpu.mesh(item.mesh);
    for (std::uint32_t s = 0; s < mesh.submesh_count; ++s) {
        const GpuScene::SubmeshRange& submesh = gpu.submesh(mesh.first_submesh + s);
        const bool two_sided = gpu.material(submesh.material).double_sided || item.winding.folded;
        catchers_.push_back({submesh.material, submesh.first_index, submesh.index_count, mesh.base_vertex,
                             static_cast<std::uint32_t>(draw_items_.size()), 1, item.winding.mirrored, two_sided, 0.0});
        draw_items_.push_back({item.gpu_slot, submesh.first_index / 3});
    }
}

/// Records a draw of each catcher. `state`: its faces are set by each.
void LightingSystem::draw_catchers(const gl::PipelineState& state, const GpuScene& gpu, gl::CommandList& list) const {
    for (const SurfaceDraw& draw : catchers_) {
        gl::PipelineState own = state;
        own.cull = draw.two_sided ? gl::CullMode::none : gl::CullMode::back;
        own.front_is_clockwise = draw.mirrored;
        list.add(gl::SetPipeline{own});
        bind_material(gpu, draw.material, list);
        list.add(
            gl::DrawMeshes{draw.first_index, draw.index_count, draw.base_vertex, draw.first_item, draw.item_count});
    }
}

/// Records the shares of light that casters take of the nearest catchers, over the picture. Depths come first and sums
/// after, so that catchers at the same place add up to the share of one.
void LightingSystem::record_catchers(const shadow::LightingInputs& inputs, const GpuScene& gpu, gl::CommandList& list,
                                     shadow::LightingOutcome& outcome) {
    if (catchers_.empty()) return;
    const gl::ProgramHandle base = programs_.catcher_base(), shares = programs_.catcher_shares();
    if (!caught_ || !base || !shares) {
        const Reason lacks = caught_ ? Reason::lighting_program_failed : Reason::target_incomplete;
        for (const shadow::LightingLight& light : inputs.lights)
            if (light.area.screen.width > 0) outcome.failures.push_back({light.light, lacks, true, true, {}});
        return;
    }
    plan_forward(inputs, ShaderPass::catcher, outcome);
    list.add(gl::BeginGroup{"catchers"});
    caught_.begin(targets_.depth, list);
    bind_scene(gpu, list);
    draw_catchers({.program = base, .depth_test = gl::DepthTest::greater, .depth_write = true}, gpu, list);
    caught_.begin_sums(list);
    gl::PipelineState sums{.program = base, .depth_test = gl::DepthTest::equal, .blend = gl::Blend::add};
    draw_catchers(sums, gpu, list);
    for (std::uint32_t i = 0; i < inputs.lights.size(); ++i) {
        sums.program = forward_programs_[i].program;
        if (!sums.program) continue;
        list.add(gl::SetScissor{inputs.lights[i].area.screen});
        list.add(gl::SetPipeline{sums});
        bind_light(forward_programs_[i], i, gpu, list);
        draw_catchers(sums, gpu, list);
    }
    list.add(gl::EndPass{});
    list.add(gl::BeginPass{targets_.light_target, viewport(), false, 0.0f, false, {}});
    list.add(gl::SetPipeline{{shares, gl::CullMode::none, false, gl::DepthTest::off, false, false, gl::Blend::alpha}});
    list.add(gl::BindTexture{bindings::kCaughtLightUnit, caught_.sums(), point_sampler_});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    list.add(gl::EndGroup{});
}

void LightingSystem::record_blended(const shadow::LightingInputs& inputs, const GpuScene& gpu, gl::CommandList& list,
                                    shadow::LightingOutcome& outcome) {
    if (blended_.empty() || !programs_.blended_base()) return;
    forward_programs_.clear();
    list.add(gl::BeginGroup{"blended"});
    list.add(gl::BeginPass{targets_.light_target, viewport(), false, 0.0f, false, {}});
    for (const SurfaceDraw& draw : blended_) {
        const gl::ProgramHandle unlit =
            gpu.material(draw.material).unlit ? programs_.unlit_blended() : gl::ProgramHandle{};
        gl::PipelineState state{unlit ? unlit : programs_.blended_base(),
                                draw.two_sided ? gl::CullMode::none : gl::CullMode::back,
                                draw.mirrored,
                                gl::DepthTest::greater,
                                false,
                                false,
                                gl::Blend::alpha};
        list.add(gl::SetPipeline{state});
        bind_scene(gpu, list);
        bind_material(gpu, draw.material, list);
        const gl::DrawMeshes meshes{draw.first_index, draw.index_count, draw.base_vertex, draw.first_item,
                                    draw.item_count};
        list.add(meshes);
        if (!unlit && forward_programs_.empty()) plan_forward(inputs, ShaderPass::blended, outcome);
        for (std::uint32_t i = 0; i < inputs.lights.size(); ++i) {
            if (unlit || inputs.lights[i].area.screen.width <= 0) continue;
            const LightProgram& used = forward_programs_[i];
            state.program = used.program;
            if (!state.program) continue;
            state.blend = gl::Blend::add;
            list.add(gl::SetPipeline{state});
            bind_light(used, i, gpu, list);
            list.add(meshes);
        }
    }
    list.add(gl::EndPass{});
    list.add(gl::EndGroup{});
}

}  // namespace gnomon::lighting
