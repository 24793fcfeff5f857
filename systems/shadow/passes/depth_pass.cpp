#include "systems/shadow/passes/depth_pass.h"

#include <algorithm>

#include "shaders/bindings.h"
#include "shaders/embedded.h"
#include "systems/frame_timers.h"
#include "systems/shadow/frame/cpu_timer.h"

namespace gnomon::shadow {
namespace {

gl::PipelineState depth_state(gl::ProgramHandle program) {
    return {program, gl::CullMode::none, false, gl::DepthTest::greater, true, true, gl::Blend::off};
}

/// Returns the casters that the view draws in this frame.
std::span<const std::uint32_t> drawn_casters(const DrawnViews& drawn, std::size_t v) {
    const ShadowView& view = drawn.view(v);
    if (drawn.updates[v].copy.use == StaticCopyUse::copy) return drawn.fitted.moving_casters_of(view);
    return drawn.fitted.casters_of(view);
}

/// Copies a layer of the map into the copy of static casters, or back.
void copy_layer(const DrawnViews& drawn, std::size_t v, bool back, gl::CommandList& list) {
    const MapAssignment& map = drawn.maps[v];
    const UpdatePlan& plan = drawn.updates[v];
    const std::uint32_t layer = drawn.view(v).layer;
    const auto copy = [&](gl::TextureHandle from, gl::TextureHandle to) {
        if (from) list.add(back ? gl::CopyTexture{to, from, layer} : gl::CopyTexture{from, to, layer});
    };
    copy(map.texture, plan.copy.texture);
    copy(map.triangles, plan.copy.triangles);
}

}  // namespace

DepthPass::DepthPass(gl::Device& device)
    : device_(device),
      items_(device, "shadow draw items"),
      records_(device, "shadow draw records"),
      views_(device, "shadow views") {}

DepthPass::~DepthPass() {
    for (const gl::ProgramHandle p : programs_) device_.destroy(p);
}

/// Returns the index of a depth program. The plan has replaced CubeRoute::automatic by a definite route.
std::size_t DepthPass::which(const DepthVariant& way, bool masked) {
    if (way.peel) return kPlainPrograms - 1;
    const std::size_t route =
        way.route == CubeRoute::layered_vertex ? 1 : (way.route == CubeRoute::layered_geometry ? 2 : 0);
    const std::size_t coloured = masked && way.coloured ? kPlainPrograms : 0;
    return coloured + 4 * route + (way.triangles ? 2 : 0) + (masked ? 1 : 0);
}

DepthPass::DepthVariant DepthPass::variant_of(const PassInputs& in, std::size_t v) const {
    const MapAssignment& map = in.drawn.maps[v];
    const CubeRoute route = is_layered(in, v) ? in.drawn.updates[v].route : CubeRoute::six_passes;
    return {route, static_cast<bool>(map.triangles), static_cast<bool>(map.sheets.second), false,
            static_cast<bool>(in.gpu.colours())};
}

/// Returns whether one pass draws the view with the others of its light.
bool DepthPass::is_layered(const PassInputs& in, std::size_t v) const {
    const std::uint32_t light = in.drawn.view(v).light;
    return in.drawn.updates[v].whole && !std::binary_search(separate_.begin(), separate_.end(), light);
}

bool DepthPass::program(const DepthVariant& way, bool masked) {
    const std::size_t i = which(way, masked);
    if (programs_[i]) return true;
    if (!retries_[i].due(frame_)) return false;
    std::vector<std::string> defines;
    defines.reserve(5);
    std::string label = masked ? "depth masked" : "depth opaque";
    if (masked) defines.emplace_back("MASKED 1");
    if (masked && way.coloured) defines.emplace_back("COLOURED 1");
    if (masked && way.coloured) label += ", coloured";
    if (way.triangles) defines.emplace_back("TRIANGLES 1");
    if (way.triangles) label += way.peel ? ", peeled" : ", triangles";
    if (way.route != CubeRoute::six_passes) defines.emplace_back("LAYERED 1");
    if (way.route == CubeRoute::layered_vertex) defines.emplace_back("LAYER_BY_VERTEX 1");
    const bool geometry = way.route == CubeRoute::layered_geometry;
    if (way.route != CubeRoute::six_passes) label += geometry ? ", layer by geometry" : ", layer by vertex";
    const auto vertex = gl::expand_shader(shader_files(), "shadow/passes/depth/depth.vert", defines);
    const auto fragment = gl::expand_shader(
        shader_files(), way.peel ? "shadow/passes/depth/depth_peel.frag" : "shadow/passes/depth/depth.frag", defines);
    const auto layer = gl::expand_shader(shader_files(), "shadow/passes/depth/layer.geom", defines);
    if (vertex && fragment && layer)
        programs_[i] =
            device_.create_program({label, vertex.value(), fragment.value(), geometry ? layer.value() : std::string()})
                .handle;
    if (!programs_[i]) retries_[i].failed(frame_);
    return static_cast<bool>(programs_[i]);
}

/// Returns why these casters cannot be drawn: a program failed, or the device has no room for their records.
/// Reason::none: they can.
Reason DepthPass::ready(const PassInputs& in, const DepthVariant& way, std::span<const std::uint32_t> casters) {
    const auto lacks_record = [&](std::uint32_t i) { return in.scene.instances[i].gpu_slot >= in.gpu.capacity(); };
    const auto is_masked = [&](std::uint32_t i) { return in.gpu.depth_facts(in.scene.instances[i].mesh).masked; };
    if (in.scene.gpu_slot_count > in.gpu.capacity() && std::any_of(casters.begin(), casters.end(), lacks_record))
        return Reason::buffer_failed;
    const bool masked = !way.sheets && in.gpu.any_masked() && std::any_of(casters.begin(), casters.end(), is_masked);
    if (way.sheets && !program({way.route, true, true, true}, false)) return Reason::depth_program_failed;
    return program(way, false) && (!masked || program(way, true)) ? Reason::none : Reason::depth_program_failed;
}

void DepthPass::prepare(const PassInputs& in, const LightAccounts& accounts) {
    ++frame_;
    separate_.clear();
    bool any = false;
    for (std::size_t v = 0; v < in.drawn.count(); ++v) {
        if (!in.drawn.is_drawn(v)) continue;
        const std::uint32_t light = in.drawn.view(v).light;
        const LightTimer time(accounts.cpu_us, light);
        const auto casters = drawn_casters(in.drawn, v);
        Reason reason = ready(in, variant_of(in, v), casters);
        if (reason == Reason::depth_program_failed && is_layered(in, v)) {
            separate_.push_back(light);  // without a layered program, each view gets its own pass, to the same maps
            reason = ready(in, variant_of(in, v), casters);
        }
        if (reason != Reason::none) {
            accounts.statuses[light].lose_maps(reason, in.drawn.lights[light].request.rays.used);
            continue;
        }
        any = true;
    }
    passes_.clear();
    if (!any) return;
    gather(in, accounts);
    if (reserve_buffers()) return;
    for (std::size_t v = 0; v < in.drawn.count(); ++v) {
        const std::uint32_t light = in.drawn.view(v).light;
        if (in.drawn.is_drawn(v))
            accounts.statuses[light].lose_maps(Reason::buffer_failed, in.drawn.lights[light].request.rays.used);
    }
}

/// Makes room for what record() uploads. Without room for records of draws, each draw is a command of its own.
bool DepthPass::reserve_buffers() {
    has_records_ = wants_records_ && records_retry_.due(frame_);
    if (has_records_ && !records_.reserve(draws_.records().size_bytes())) {
        records_retry_.failed(frame_);
        has_records_ = false;
    }
    return items_.reserve(std::max(draws_.items().size_bytes(), sizeof(DepthItem))) &&
           views_.reserve(view_scratch_.size());
}

/// Opens the pass on cleared faces, or on those of static casters alone. A layered clear would clear every face, so it
/// is for a pass that draws every face.
void DepthPass::begin(const PassInputs& in, const Pass& pass, gl::CommandList& list) {
    const UpdatePlan& plan = in.drawn.updates[pass.first];
    const auto size = static_cast<std::int32_t>(in.drawn.maps[pass.first].size_px);
    const ShadowView& view = in.drawn.view(pass.first);
    const std::string layer = pass.layered ? "faces" : std::to_string(view.layer);
    list.add(gl::BeginGroup{{"shadow", in.scene.lights[view.light].name, layer}});
    list.add(gl::BeginTimer{shadow_timer(view.light)});
    const bool one_clear = !pass.layered || pass.views == kFaces;
    for (std::size_t v = pass.first; v < pass.end && !one_clear; ++v) {
        if (!in.drawn.is_drawn(v)) continue;
        list.add(gl::BeginPass{in.drawn.maps[v].target, {0, 0, size, size}, true, 0.0f, false, {}});
        list.add(gl::EndPass{});
    }
    if (plan.copy.use == StaticCopyUse::copy) copy_layer(in.drawn, pass.first, true, list);
    begin_pass(in, pass, one_clear && plan.copy.use != StaticCopyUse::copy && !plan.begun_by_engine, list);
}

/// Lists the casters of a pass that the engine draws. They come first: where another caster is nearer, it is drawn over
/// them, with its triangle.
void DepthPass::list_engine_draws(const PassInputs& in, const Pass& pass, LightReport& report) {
    if (!in.drawn.updates[pass.first].begun_by_engine) return;
    const ShadowView& view = in.drawn.view(pass.first);
    const MapAssignment& map = in.drawn.maps[pass.first];
    bool first = true;
    for (const std::uint32_t i : in.drawn.fitted.casters_of(view)) {
        if (!in.scene.instances[i].drawable.drawn) continue;
        engine_draws_.push_back({i, view.light, map.target, map.size_px, first, map.triangle_bits,
                                 view.clip_from_anchor, view.pose.anchor_ws_m});
        first = false;
        ++report.counts.draws;
        ++report.counts.draw_commands;
    }
}

void DepthPass::begin_pass(const PassInputs& in, const Pass& pass, bool clear, gl::CommandList& list) {
    begin_pass_into(pass.layered ? in.drawn.updates[pass.first].whole : in.drawn.maps[pass.first].target, in, pass,
                    clear, list);
}

void DepthPass::begin_pass_into(gl::TargetHandle target, const PassInputs& in, const Pass& pass, bool clear,
                                gl::CommandList& list) {
    const auto size = static_cast<std::int32_t>(in.drawn.maps[pass.first].size_px);
    list.add(gl::BeginPass{target, {0, 0, size, size}, clear, 0.0f, false, {}});
    const std::size_t records = pass.layered ? kFaces : 1;
    list.add(gl::BindUniforms{bindings::kDepthViewBlock, views_.handle(), pass.uniform_offset,
                              static_cast<std::uint32_t>(records * sizeof(DepthViewRecord))});
    list.add(gl::BindTexels{bindings::kInstanceUnit, in.gpu.instances()});
    if (in.gpu.colours()) list.add(gl::BindTexels{bindings::kColourUnit, in.gpu.colours()});
    bound_ = meshes_of(in.gpu, nullptr);
    list.add(bound_);
}

/// Returns the buffers that draws of a mesh read: the scene's, or those of the engine that has the mesh.
gl::BindMeshes DepthPass::meshes_of(const GpuScene& gpu, const EngineMesh* engine) const {
    if (engine) return {engine->vertices, engine->indices, items_.handle(), engine->layout};
    return {gpu.vertices(), gpu.indices(), items_.handle()};
}

void DepthPass::draw(const PassInputs& in, const Pass& pass, const DepthVariant& way, IndexRange batches,
                     gl::CommandList& list, LightReport& report) {
    const LightItem& light = in.scene.lights[in.drawn.view(pass.first).light];
    const bool together = has_records_ && light.tuning.maps.multi_draw;
    for (const DepthDraws::Batch& batch : draws_.batches(batches)) {
        set_state(in, pass, way, batch, list);
        const auto records = draws_.records().subspan(batch.draws.first, batch.draws.count);
        if (together && records.size() > 1) {
            list.add(gl::DrawMeshesIndirect{records_.handle(), batch.draws.first, batch.draws.count, batch.end_index,
                                            batch.end_item});
            ++report.counts.draw_commands;
        } else {
            for (const gl::MeshDrawRecord& r : records)
                list.add(gl::DrawMeshes{r.first_index, r.index_count, r.base_vertex, r.first_item, r.item_count});
            report.counts.draw_commands += batch.draws.count;
        }
        report.counts.draws += batch.draws.count;
        report.counts.triangles += batch.triangles;
        report.counts.full_triangles += batch.triangles;
    }
}

/// Sets what the draws of a batch need, where it differs from what is set.
void DepthPass::set_state(const PassInputs& in, const Pass& pass, const DepthVariant& way,
                          const DepthDraws::Batch& batch, gl::CommandList& list) {
    if (batch.mask) {
        list.add(gl::BindTexture{bindings::kBaseColourUnit, batch.mask->texture, batch.mask->sampler});
        list.add(gl::BindUniforms{bindings::kMaterialBlock, in.gpu.material_uniforms(), batch.mask->uniform_offset,
                                  sizeof(MaterialRecord)});
    }
    gl::PipelineState state = depth_state(programs_[which(way, batch.mask != nullptr)]);
    if (batch.faces != DrawnFaces::both) {
        const LightItem& light = in.scene.lights[in.drawn.view(pass.first).light];
        state.cull = light.shadow.caster_faces == CasterFaces::back ? gl::CullMode::front : gl::CullMode::back;
        state.front_is_clockwise = batch.faces == DrawnFaces::one_side_mirrored;
    }
    if (!(pipeline_ == state)) list.add(gl::SetPipeline{state});
    pipeline_ = state;
    const gl::BindMeshes read = meshes_of(in.gpu, batch.engine);
    if (!(bound_ == read)) list.add(read);
    bound_ = read;
}

/// Draws the same casters once more, without the triangles that the first map shows.
void DepthPass::peel(const PassInputs& in, const Pass& pass, gl::CommandList& list, LightReport& report) {
    const MapAssignment& map = in.drawn.maps[pass.first];
    pipeline_ = {};
    begin_pass_into(map.sheets.second_target, in, pass, true, list);
    list.add(gl::BindTexture{bindings::kNearestTriangleUnit, map.triangles, {}});
    const DepthVariant way{in.drawn.updates[pass.first].route, true, true, true};
    draw(in, pass, way, pass.still, list, report);
    draw(in, pass, way, pass.moving, list, report);
    list.add(gl::BindTexture{bindings::kNearestTriangleUnit, {}, {}});
    list.add(gl::EndPass{});
}

void DepthPass::record(const PassInputs& in, const PassOutputs& out) {
    engine_draws_.clear();
    const auto lost = [&](const Pass& pass) { return !in.drawn.is_drawn(pass.first); };
    std::erase_if(passes_, lost);  // a later recorder had no room for what belongs to the maps
    if (passes_.empty()) return;
    gl::CommandList& list = out.list;
    list.update(items_.handle(), 0, draws_.items());
    if (has_records_) list.update(records_.handle(), 0, draws_.records());
    list.update(views_.handle(), 0, std::span<const std::byte>(view_scratch_));
    for (const Pass& pass : passes_) {
        const std::uint32_t light = in.drawn.view(pass.first).light;
        const LightTimer time(out.cpu_us, light);
        LightReport& report = out.report.lights[light];
        const StaticCopyUse copy_use = in.drawn.updates[pass.first].copy.use;
        pipeline_ = {};
        list_engine_draws(in, pass, report);
        begin(in, pass, list);
        const DepthVariant way = variant_of(in, pass.first);
        draw(in, pass, way, pass.still, list, report);
        if (copy_use == StaticCopyUse::fill) {
            list.add(gl::EndPass{});
            copy_layer(in.drawn, pass.first, false, list);
            begin_pass(in, pass, false, list);
        }
        draw(in, pass, way, pass.moving, list, report);
        list.add(gl::EndPass{});
        report.counts.full_triangles += pass.saved_triangles;
        if (way.sheets) peel(in, pass, list, report);
        list.add(gl::EndTimer{shadow_timer(light)});
        list.add(gl::EndGroup{});
        if (copy_use != StaticCopyUse::copy) report.counts.clears += pass.views;
        report.counts.views_drawn += pass.views;
    }
}

}  // namespace gnomon::shadow
