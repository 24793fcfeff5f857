#include "systems/shadow/passes/tint_pass.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/math/projection.h"
#include "shaders/bindings.h"
#include "shaders/embedded.h"
#include "systems/extract/instance_order.h"
#include "systems/frame_timers.h"

namespace gnomon::shadow {

TintPass::TintPass(gl::Device& device)
    : device_(device), items_(device, "translucent draw items"), records_(device, "translucent casters") {}

TintPass::~TintPass() { release(); }

void TintPass::release() {
    for (gl::ProgramHandle& program : programs_) device_.destroy(std::exchange(program, {}));
    for (gl::TargetHandle& target : scratch_targets_) device_.destroy(std::exchange(target, {}));
    for (gl::TextureHandle& texture : scratch_) device_.destroy(std::exchange(texture, {}));
    scratch_px_ = 0;
    items_.release();
    records_.release();
}

std::uint64_t TintPass::scratch_bytes() const {
    return std::uint64_t{kTintLayers} * scratch_px_ * scratch_px_ * gl::texel_bytes(gl::Format::d32f);
}

bool TintPass::program(Step step, bool coloured) {
    if (programs_[step]) return true;
    constexpr std::array kNames{"translucent first", "translucent behind", "translucent depths", "translucent sums"};
    constexpr std::array kFiles{"peel.frag", "peel.frag", "gather_depths.frag", "absorb.frag"};
    std::vector<std::string> defines;
    if (step == kBehind) defines.emplace_back("PEELED 1");
    if (step != kGather && coloured) defines.emplace_back("COLOURED 1");
    const auto vertex = gl::expand_shader(
        shader_files(), step == kGather ? "common/fullscreen.vert" : "shadow/passes/depth/depth.vert", defines);
    const auto fragment = gl::expand_shader(shader_files(), std::string("shadow/passes/tint/") + kFiles[step], defines);
    if (vertex && fragment)
        programs_[step] = device_.create_program({kNames[step], vertex.value(), fragment.value()}).handle;
    return static_cast<bool>(programs_[step]);
}

/// Makes the depths of layers, as large as the largest view needs them.
bool TintPass::provide_scratch(std::uint32_t edge_px) {
    if (edge_px <= scratch_px_) return true;
    for (std::size_t i = 0; i < kTintLayers; ++i) {
        device_.destroy(std::exchange(scratch_targets_[i], {}));
        device_.destroy(std::exchange(scratch_[i], {}));
    }
    scratch_px_ = 0;
    for (std::size_t i = 0; i < kTintLayers; ++i) {
        const gl::TextureDesc desc{
            .label = "translucent layer", .format = gl::Format::d32f, .width = edge_px, .height = edge_px};
        scratch_[i] = device_.create_texture(desc, {}).handle;
        if (scratch_[i]) scratch_targets_[i] = device_.create_target({desc.label, {}, {scratch_[i]}}).handle;
        if (!scratch_targets_[i]) return false;
    }
    scratch_px_ = edge_px;
    return true;
}

/// Gathers the draws of one view's translucent casters. They are ordered by mesh, as the view's casters are.
void TintPass::gather_draws(const PassInputs& in, std::span<const std::uint32_t> casters) {
    const std::uint32_t stride = aligned(sizeof(TransmissionRecord), device_.info().uniform_alignment);
    for_each_mesh_run(in.scene, casters, [&](std::uint32_t mesh, std::uint32_t first, std::uint32_t count) {
        if (in.gpu.engine_mesh(mesh)) return;
        const GpuScene::MeshRange& range = in.gpu.mesh(mesh);
        const auto first_item = static_cast<std::uint32_t>(item_scratch_.size());
        bool any = false;
        for (std::uint32_t s = 0; s < range.submesh_count; ++s) {
            const GpuScene::SubmeshRange& submesh = in.gpu.submesh(range.first_submesh + s);
            const GpuScene::MaterialInfo& material = in.gpu.material(submesh.material);
            if (!material.transmits) continue;
            any = true;
            const bool blended = material.alpha_mode == assets::AlphaMode::blend;
            const auto offset = static_cast<std::uint32_t>(record_scratch_.size());
            put_record(record_scratch_, offset,
                       TransmissionRecord{glm::vec4(material.transmission, blended ? 1.0f : 0.0f)});
            record_scratch_.resize(offset + std::size_t{stride});
            draws_.push_back({submesh.material, submesh.first_index, submesh.index_count, first_item, count,
                              range.base_vertex, offset});
        }
        for (std::uint32_t i = first; any && i < first + count; ++i)
            item_scratch_.push_back({in.scene.instances[casters[i]].gpu_slot, 0});
    });
}

/// Gathers what this frame draws, view by view.
void TintPass::gather(const PassInputs& in, std::span<const TintAssignment> tints) {
    views_.clear();
    draws_.clear();
    item_scratch_.clear();
    record_scratch_.clear();
    for (std::size_t v = 0; v < tints.size(); ++v) {
        if (!tints[v].drawn) continue;
        const ShadowView& shown = in.drawn.view(v);
        View& view = views_.emplace_back();
        view.v = v;
        view.record_offset = static_cast<std::uint32_t>(record_scratch_.size());
        const math::TwoFloat3 anchor = math::split(shown.pose.anchor_ws_m);
        put_record(record_scratch_, view.record_offset,
                   DepthViewRecord{shown.clip_from_anchor, glm::vec4(anchor.high, 0.0f), glm::vec4(anchor.low, 0.0f)});
        record_scratch_.resize(view.record_offset +
                               std::size_t{aligned(sizeof(DepthViewRecord), device_.info().uniform_alignment)});
        view.first_draw = draws_.size();
        gather_draws(in, in.drawn.fitted.casters_of(shown));
        view.draws = draws_.size() - view.first_draw;
    }
}

void TintPass::prepare(const PassInputs& in, std::span<const TintAssignment> tints, std::span<LightStatus> statuses) {
    ++frame_;
    gather(in, tints);
    if (views_.empty()) return;
    const bool coloured = static_cast<bool>(in.gpu.colours());
    if (coloured != std::exchange(coloured_, coloured))
        for (gl::ProgramHandle& program : programs_) device_.destroy(std::exchange(program, {}));
    std::uint32_t edge_px = 0;
    for (const View& view : views_) edge_px = std::max(edge_px, tints[view.v].edge_px);
    bool ready = retry_.due(frame_);
    for (std::size_t step = 0; ready && step < kSteps; ++step) ready = program(static_cast<Step>(step), coloured);
    ready = ready && provide_scratch(edge_px) &&
            items_.reserve(std::max<std::size_t>(item_scratch_.size(), 1) * sizeof(DrawItem)) &&
            records_.reserve(record_scratch_.size());
    if (ready) return;
    if (retry_.due(frame_)) retry_.failed(frame_);
    for (const View& view : views_) statuses[in.drawn.view(view.v).light].lose_tint(Reason::tint_failed);
    views_.clear();
}

/// Begins a pass over a view's casters, into a cleared target: of depths, or of colours.
void TintPass::begin(const PassInputs& in, const View& view, gl::TargetHandle target, bool depths,
                     std::uint32_t edge_px, gl::CommandList& list) const {
    const auto size = static_cast<std::int32_t>(edge_px);
    list.add(gl::BeginPass{target, {0, 0, size, size}, depths, 0.0f, !depths, {}});
    list.add(gl::BindUniforms{bindings::kDepthViewBlock, records_.handle(), view.record_offset,
                              static_cast<std::uint32_t>(sizeof(DepthViewRecord))});
    list.add(gl::BindTexels{bindings::kInstanceUnit, in.gpu.instances()});
    if (in.gpu.colours()) list.add(gl::BindTexels{bindings::kColourUnit, in.gpu.colours()});
    list.add(gl::BindMeshes{in.gpu.vertices(), in.gpu.indices(), items_.handle()});
}

void TintPass::draw(const PassInputs& in, const View& view, const gl::PipelineState& state, gl::CommandList& list,
                    LightReport& report) const {
    list.add(gl::SetPipeline{state});
    for (const Draw& draw : std::span(draws_).subspan(view.first_draw, view.draws)) {
        const GpuScene::MaterialInfo& material = in.gpu.material(draw.material);
        list.add(gl::BindUniforms{bindings::kMaterialBlock, in.gpu.material_uniforms(), material.uniform_offset,
                                  static_cast<std::uint32_t>(sizeof(MaterialRecord))});
        list.add(gl::BindUniforms{bindings::kTransmissionBlock, records_.handle(), draw.record_offset,
                                  static_cast<std::uint32_t>(sizeof(TransmissionRecord))});
        list.add(gl::BindTexture{bindings::kBaseColourUnit, material.texture, material.sampler});
        list.add(
            gl::DrawMeshes{draw.first_index, draw.index_count, draw.base_vertex, draw.first_item, draw.item_count});
        ++report.counts.draws;
        ++report.counts.draw_commands;
        const std::uint64_t triangles = std::uint64_t{draw.index_count} / 3 * draw.item_count;
        report.counts.triangles += triangles;
        report.counts.full_triangles += triangles;
    }
}

void TintPass::bind_layers(bool bound, gl::CommandList& list) const {
    for (std::uint32_t i = 0; i < kTintLayers; ++i)
        list.add(gl::BindTexture{bindings::kPeeledDepthUnit + i, bound ? scratch_[i] : gl::TextureHandle{}, {}});
}

/// Records the passes of one view. One without translucent casters only has its depths cleared.
void TintPass::record_view(const PassInputs& in, const View& view, const TintAssignment& tint, gl::CommandList& list,
                           LightReport& report) {
    for (std::size_t i = 0; i < kTintLayers && view.draws > 0; ++i) {
        begin(in, view, scratch_targets_[i], true, tint.edge_px, list);
        if (i > 0) list.add(gl::BindTexture{bindings::kPeeledDepthUnit, scratch_[i - 1], {}});
        draw(in, view,
             {.program = programs_[i > 0 ? kBehind : kFirst],
              .depth_test = gl::DepthTest::greater,
              .depth_write = true,
              .depth_clamp = true},
             list, report);
        if (i > 0) list.add(gl::BindTexture{bindings::kPeeledDepthUnit, {}, {}});
        list.add(gl::EndPass{});
    }
    const auto size = static_cast<std::int32_t>(tint.edge_px);
    list.add(gl::BeginPass{tint.depths, {0, 0, size, size}, false, 0.0f, true, {}});
    if (view.draws > 0) {
        bind_layers(true, list);
        list.add(gl::SetPipeline{{.program = programs_[kGather]}});
        list.add(gl::DrawTriangle{});
    }
    list.add(gl::EndPass{});
    if (view.draws == 0) return;
    begin(in, view, tint.absorbances, false, tint.edge_px, list);
    draw(in, view, {.program = programs_[kAbsorb], .depth_clamp = true, .blend = gl::Blend::add}, list, report);
    list.add(gl::EndPass{});
    bind_layers(false, list);
}

void TintPass::record(const PassInputs& in, std::span<const TintAssignment> tints, const PassOutputs& out) {
    if (views_.empty()) return;
    out.list.update(items_.handle(), 0, std::span<const DrawItem>(item_scratch_));
    out.list.update(records_.handle(), 0, std::span<const std::byte>(record_scratch_));
    for (const View& view : views_) {
        const ShadowView& shown = in.drawn.view(view.v);
        const std::string layer = std::to_string(shown.layer);
        out.list.add(gl::BeginGroup{{"translucent casters", in.scene.lights[shown.light].name, layer}});
        out.list.add(gl::BeginTimer{shadow_timer(shown.light)});
        record_view(in, view, tints[view.v], out.list, out.report.lights[shown.light]);
        out.list.add(gl::EndTimer{shadow_timer(shown.light)});
        out.list.add(gl::EndGroup{});
    }
}

}  // namespace gnomon::shadow
