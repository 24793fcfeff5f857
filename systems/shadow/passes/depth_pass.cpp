#include "systems/shadow/passes/depth_pass.h"

#include <algorithm>
#include <cstring>

#include "engine/math/projection.h"
#include "shaders/embedded.h"
#include "systems/extract/instance_order.h"
#include "systems/frame_timers.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/passes/mesh_draw_ranges.h"
#include "systems/shadow/update/drawn_views.h"

namespace gnomon::shadow {
namespace {

bool has_masked(const GpuScene& gpu, std::uint32_t mesh) {
    const auto& range = gpu.mesh(mesh);
    for (std::uint32_t s = 0; s < range.submesh_count; ++s)
        if (gpu.material(gpu.submesh(range.first_submesh + s).material).alpha_mode == assets::AlphaMode::mask)
            return true;
    return false;
}

gl::PipelineState depth_state(gl::ProgramHandle program) {
    return {program, gl::CullMode::none, false, gl::DepthTest::greater, true, true, gl::Blend::off};
}

/// All that a view draws in this frame.
std::span<const std::uint32_t> drawn_casters(const ShadowFrame& frame, std::size_t v) {
    const ShadowView& view = frame.views[v];
    if (frame.slots[v].still_use == StillUse::copy) return moving_casters(frame, view);
    return std::span(frame.view_caster_items).subspan(view.casters.first, view.casters.count);
}

/// A layer of the map into the store of still casters, or back.
void copy_layer(const ShadowSlot& slot, std::uint32_t layer, bool back, gl::CommandList& list) {
    const auto copy = [&](gl::TextureHandle map, gl::TextureHandle still) {
        if (map) list.add(back ? gl::CopyTexture{still, map, layer} : gl::CopyTexture{map, still, layer});
    };
    copy(slot.texture, slot.still);
    copy(slot.triangles, slot.still_triangles);
}

/// For want of a layered program: the maps are the same.
void draw_separately(ShadowFrame& frame, std::uint32_t demand) {
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        if (frame.views[v].demand != demand) continue;
        frame.slots[v].whole = {};
        frame.slots[v].route = CubeRoute::six_passes;
    }
}

}  // namespace

DepthRecorder::DepthRecorder(gl::Device& device)
    : device_(device), items_(device, "shadow draw items"), views_(device, "shadow views") {}

DepthRecorder::~DepthRecorder() {
    for (const gl::ProgramHandle p : programs_) device_.destroy(p);
}

/// Index of a depth program. `automatic` has become one of the others by now.
std::size_t DepthRecorder::which(const Way& way, bool masked) {
    if (way.peel) return kPlainPrograms - 1;
    const std::size_t route =
        way.route == CubeRoute::layered_vertex ? 1 : (way.route == CubeRoute::layered_geometry ? 2 : 0);
    const std::size_t coloured = masked && way.coloured ? kPlainPrograms : 0;
    return coloured + 4 * route + (way.triangles ? 2 : 0) + (masked ? 1 : 0);
}

DepthRecorder::Way DepthRecorder::way_of(const GpuScene& gpu, const ShadowSlot& slot) {
    return {slot.route, static_cast<bool>(slot.triangles), static_cast<bool>(slot.second), false,
            static_cast<bool>(gpu.colours())};
}

bool DepthRecorder::program(const Way& way, bool masked) {
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

/// What keeps these casters from being drawn: nothing, a program, or that the device has no room for their records.
Reason DepthRecorder::ready(const SceneSnapshot& scene, const GpuScene& gpu, const Way& way,
                            std::span<const std::uint32_t> casters) {
    bool masked = false;
    for (const std::uint32_t i : casters) {
        if (scene.instances[i].gpu_slot >= gpu.capacity()) return Reason::buffer_failed;
        masked = masked || (!way.sheets && has_masked(gpu, scene.instances[i].mesh));
    }
    if (way.sheets && !program({way.route, true, true, true}, false)) return Reason::depth_program_failed;
    return program(way, false) && (!masked || program(way, true)) ? Reason::none : Reason::depth_program_failed;
}

std::size_t DepthRecorder::item_count(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame,
                                      std::size_t v) const {
    const auto casters = drawn_casters(frame, v);
    if (!frame.slots[v].triangles) return casters.size();
    std::size_t items = 0;
    for (const std::uint32_t i : casters)
        for_each_depth_run(gpu, scene.instances[i].mesh, [&](const DepthRun&) { ++items; });
    return items;
}

void DepthRecorder::prepare(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame) {
    ++frame_;
    std::size_t items = 0, views = 0;
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        if (!is_drawn(frame, v)) continue;
        const ShadowView& view = frame.views[v];
        const LightTime time(frame, frame.demands[view.demand].light);
        const auto casters = drawn_casters(frame, v);
        const ShadowSlot& slot = frame.slots[v];
        if (slot.whole && ready(scene, gpu, way_of(gpu, slot), casters) == Reason::depth_program_failed)
            draw_separately(frame, view.demand);
        const Reason reason = ready(scene, gpu, way_of(gpu, slot), casters);
        if (reason != Reason::none) {
            drop_light(frame, view.demand, reason);
            continue;
        }
        items += item_count(scene, gpu, frame, v);
        ++views;
    }
    if (views == 0) return;
    const std::uint32_t stride = aligned(sizeof(DepthViewRecord), device_.info().uniform_alignment);
    // A layered pass has at least two views and takes room for six.
    const std::size_t bytes = views * std::max<std::size_t>(stride, aligned(kFaces * sizeof(DepthViewRecord) / 2,
                                                                            device_.info().uniform_alignment));
    if (!items_.reserve(std::max<std::size_t>(items, 1) * sizeof(DrawItem)) || !views_.reserve(bytes))
        for (std::size_t v = 0; v < frame.views.size(); ++v)
            if (is_drawn(frame, v)) drop_light(frame, frame.views[v].demand, Reason::buffer_failed);
}

/// From outside a solid the nearest surface is always a front face: one side of it is enough. From inside, where the
/// light is in its box, there are only back faces, and the box does not tell which it is.
gl::PipelineState DepthRecorder::opaque_state(const GpuScene& gpu, const ShadowView& view, const LightItem& light,
                                              const InstanceItem& item) const {
    gl::PipelineState state = depth_state(programs_[which(way_, false)]);
    if (way_.sheets) return state;
    const CasterFaces faces = light.shadow.caster_faces;
    const bool outside =
        view.projection == ViewProjection::orthographic || math::distance(item.bounds_ws, apex_ws_m(view)) > 0.0;
    if (faces == CasterFaces::both || !outside || item.folded || !gpu.mesh(item.mesh).solid) return state;
    state.cull = faces == CasterFaces::back ? gl::CullMode::front : gl::CullMode::back;
    state.front_is_clockwise = item.mirrored;
    return state;
}

/// Draws `count` instances of a mesh. `items_per_draw`: between the items of one draw and those of the next.
void DepthRecorder::draw_run(const GpuScene& gpu, std::uint32_t mesh, const gl::PipelineState& opaque,
                             std::uint32_t first_item, std::uint32_t count, std::uint32_t items_per_draw,
                             gl::CommandList& list, LightReport& report) {
    for_each_depth_run(gpu, mesh, [&](const DepthRun& run) {
        const std::uint32_t item = first_item;
        first_item += items_per_draw;
        if (run.mask && way_.sheets) return;
        if (run.mask) {
            list.add(gl::BindTexture{0, run.mask->texture, run.mask->sampler});
            list.add(gl::BindUniforms{2, gpu.material_uniforms(), run.mask->uniform_offset, sizeof(MaterialRecord)});
        }
        const gl::PipelineState state = run.mask ? depth_state(programs_[which(way_, true)]) : opaque;
        if (!(pipeline_ == state)) list.add(gl::SetPipeline{state});
        pipeline_ = state;
        list.add(gl::DrawMeshes{run.first_index, run.index_count, gpu.mesh(mesh).base_vertex, item, count});
        ++report.draws;
        report.triangles += std::uint64_t{run.index_count} / 3 * count;
    });
}

/// Opens the pass on cleared faces, or on those of still casters alone. A layered clear would clear every face, so it
/// is for when every face is drawn.
void DepthRecorder::begin(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame, const Pass& pass,
                          gl::CommandList& list) const {
    const ShadowSlot& slot = frame.slots[pass.first];
    const auto size = static_cast<std::int32_t>(slot.size_px);
    const std::uint32_t light = frame.demands[frame.views[pass.first].demand].light;
    const std::string layer = pass.layered ? "faces" : std::to_string(frame.views[pass.first].layer);
    list.add(gl::BeginGroup{{"shadow", scene.lights[light].name, layer}});
    list.add(gl::BeginTimer{shadow_timer(light)});
    const bool one_clear = !pass.layered || pass.views == kFaces;
    for (std::size_t v = pass.first; v < pass.end && !one_clear; ++v) {
        if (!is_drawn(frame, v)) continue;
        list.add(gl::BeginPass{frame.slots[v].target, {0, 0, size, size}, true, 0.0f, false, {}});
        list.add(gl::EndPass{});
    }
    if (slot.still_use == StillUse::copy) copy_layer(slot, frame.views[pass.first].layer, true, list);
    begin_pass(gpu, frame, pass, one_clear && slot.still_use != StillUse::copy, list);
}

void DepthRecorder::begin_pass(const GpuScene& gpu, const ShadowFrame& frame, const Pass& pass, bool clear,
                               gl::CommandList& list) const {
    const ShadowSlot& slot = frame.slots[pass.first];
    begin_pass_into(pass.layered ? slot.whole : slot.target, gpu, frame, pass, clear, list);
}

void DepthRecorder::begin_pass_into(gl::TargetHandle target, const GpuScene& gpu, const ShadowFrame& frame,
                                    const Pass& pass, bool clear, gl::CommandList& list) const {
    const auto size = static_cast<std::int32_t>(frame.slots[pass.first].size_px);
    list.add(gl::BeginPass{target, {0, 0, size, size}, clear, 0.0f, false, {}});
    const std::size_t records = pass.layered ? kFaces : 1;
    list.add(gl::BindUniforms{0, views_.handle(), pass.uniform_offset,
                              static_cast<std::uint32_t>(records * sizeof(DepthViewRecord))});
    list.add(gl::BindTexels{kInstanceUnit, gpu.instances()});
    if (gpu.colours()) list.add(gl::BindTexels{kColourUnit, gpu.colours()});
    list.add(gl::BindMeshes{gpu.vertices(), gpu.indices(), items_.handle()});
}

void DepthRecorder::draw(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame, const Pass& pass,
                         const Way& way, const Group& group, gl::CommandList& list, LightReport& report) {
    const auto casters = std::span(caster_scratch_).subspan(group.casters.first, group.casters.count);
    const ShadowView& view = frame.views[pass.first];
    way_ = way;
    std::uint32_t next_item = group.first_item;
    const LightItem& light = scene.lights[frame.demands[view.demand].light];
    const auto state_of = [&](std::uint32_t i) { return opaque_state(gpu, view, light, scene.instances[casters[i]]); };
    for_each_mesh_run(scene, casters, [&](std::uint32_t mesh, std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t from = first, to = first; from < first + count; from = to) {
            const gl::PipelineState state = state_of(from);
            while (to < first + count && state_of(to) == state) ++to;
            draw_run(gpu, mesh, state, next_item + from - first, to - from, way_.triangles ? count : 0, list, report);
        }
        std::uint32_t draws = 1;
        if (way_.triangles) {
            draws = 0;
            for_each_depth_run(gpu, mesh, [&](const DepthRun&) { ++draws; });
        }
        next_item += draws * count;
    });
}

/// The same once more, without what the first map shows.
void DepthRecorder::peel(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame, const Pass& pass,
                         gl::CommandList& list, LightReport& report) {
    const ShadowSlot& slot = frame.slots[pass.first];
    pipeline_ = {};
    begin_pass_into(slot.second_target, gpu, frame, pass, true, list);
    list.add(gl::BindTexture{0, slot.triangles, {}});
    const Way way{slot.route, true, true, true};
    draw(scene, gpu, frame, pass, way, pass.still, list, report);
    draw(scene, gpu, frame, pass, way, pass.moving, list, report);
    list.add(gl::BindTexture{0, {}, {}});
    list.add(gl::EndPass{});
}

void DepthRecorder::record(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame, gl::CommandList& list,
                           FrameReport& report) {
    gather(scene, gpu, frame);
    if (passes_.empty()) return;
    list.update(items_.handle(), 0, std::span<const DrawItem>(item_scratch_));
    list.update(views_.handle(), 0, std::span<const std::byte>(view_scratch_));
    for (const Pass& pass : passes_) {
        const std::uint32_t light = frame.demands[frame.views[pass.first].demand].light;
        const LightTime time(frame, light);
        LightReport& light_report = report.lights[light];
        const ShadowSlot& slot = frame.slots[pass.first];
        pipeline_ = {};
        begin(scene, gpu, frame, pass, list);
        const Way way = way_of(gpu, slot);
        draw(scene, gpu, frame, pass, way, pass.still, list, light_report);
        if (slot.still_use == StillUse::fill) {
            list.add(gl::EndPass{});
            copy_layer(slot, frame.views[pass.first].layer, false, list);
            begin_pass(gpu, frame, pass, false, list);
        }
        draw(scene, gpu, frame, pass, way, pass.moving, list, light_report);
        list.add(gl::EndPass{});
        if (way.sheets) peel(scene, gpu, frame, pass, list, light_report);
        list.add(gl::EndTimer{shadow_timer(light)});
        list.add(gl::EndGroup{});
        if (slot.still_use != StillUse::copy) light_report.clears += pass.views;
        light_report.views_drawn += pass.views;
    }
}

}  // namespace gnomon::shadow
