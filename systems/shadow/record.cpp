#include "systems/shadow/record.h"

#include <cstring>

#include "engine/math/projection.h"
#include "shaders/embedded.h"
#include "systems/extract/instance_order.h"
#include "systems/frame_timers.h"
#include "systems/shadow/light_time.h"

namespace gnomon::shadow {
namespace {

constexpr std::uint32_t kOpaque = 0, kMasked = 1;

bool is_drawn(const ShadowFrame& frame, std::size_t view) {
    return frame.slots[view].target && !frame.slots[view].reuse;
}

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

void drop_light(ShadowFrame& frame, std::uint32_t demand, Reason reason) {
    frame.sets[demand].skip = reason;
    for (std::size_t v = 0; v < frame.views.size(); ++v)
        if (frame.views[v].demand == demand) frame.slots[v] = {};
}

}  // namespace

DepthRecorder::DepthRecorder(gl::Device& device)
    : device_(device), items_(device, "shadow draw items"), views_(device, "shadow views") {}

DepthRecorder::~DepthRecorder() {
    for (const gl::ProgramHandle p : programs_) device_.destroy(p);
}

bool DepthRecorder::program(bool masked) {
    const std::uint32_t which = masked ? kMasked : kOpaque;
    if (programs_[which]) return true;
    if (!retries_[which].due(frame_)) return false;
    const std::vector<std::string> defines = masked ? std::vector<std::string>{"MASKED 1"} : std::vector<std::string>{};
    const auto vertex = gl::expand_shader(shader_files(), "shadow/depth/depth.vert", defines);
    const auto fragment = gl::expand_shader(shader_files(), "shadow/depth/depth.frag", defines);
    if (vertex && fragment)
        programs_[which] =
            device_.create_program({masked ? "depth masked" : "depth opaque", vertex.value(), fragment.value()}).handle;
    if (!programs_[which]) retries_[which].failed(frame_);
    return static_cast<bool>(programs_[which]);
}

/// What keeps these casters from being drawn: nothing, a program, or that the device has no room for their records.
Reason DepthRecorder::ready(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const std::uint32_t> casters) {
    bool masked = false;
    for (const std::uint32_t i : casters) {
        if (scene.instances[i].gpu_slot >= gpu.capacity()) return Reason::buffer_failed;
        masked = masked || has_masked(gpu, scene.instances[i].mesh);
    }
    return program(false) && (!masked || program(true)) ? Reason::none : Reason::depth_program_failed;
}

void DepthRecorder::prepare(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame) {
    ++frame_;
    std::size_t items = 0, views = 0;
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        if (!is_drawn(frame, v)) continue;
        const ShadowView& view = frame.views[v];
        const LightTime time(frame, frame.demands[view.demand].light);
        const auto casters = std::span(frame.view_caster_items).subspan(view.casters.first, view.casters.count);
        const Reason reason = ready(scene, gpu, casters);
        if (reason != Reason::none) {
            drop_light(frame, view.demand, reason);
            continue;
        }
        items += view.casters.count;
        ++views;
    }
    if (views == 0) return;
    const std::uint32_t stride = aligned(sizeof(DepthViewRecord), device_.info().uniform_alignment);
    if (!items_.reserve(std::max<std::size_t>(items, 1) * sizeof(DrawItem)) || !views_.reserve(views * stride))
        for (std::size_t v = 0; v < frame.views.size(); ++v)
            if (is_drawn(frame, v)) drop_light(frame, frame.views[v].demand, Reason::buffer_failed);
}

/// From outside a solid the nearest surface is always a front face: its back faces need not be drawn. From inside,
/// where the light is in its box, there are only back faces.
gl::PipelineState DepthRecorder::opaque_state(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowView& view,
                                              std::span<const std::uint32_t> run) const {
    gl::PipelineState state = depth_state(programs_[kOpaque]);
    const InstanceItem& head = scene.instances[run.front()];
    if (!gpu.mesh(head.mesh).solid) return state;
    const bool distant = view.projection == ViewProjection::orthographic;
    for (const std::uint32_t i : run) {
        const InstanceItem& item = scene.instances[i];
        const bool outside = distant || math::distance(item.bounds_ws, view.anchor_ws_m) > 0.0;
        if (!outside || item.mirrored != head.mirrored) return state;
    }
    state.cull = gl::CullMode::back;
    state.front_is_clockwise = head.mirrored;
    return state;
}

void DepthRecorder::draw_run(const GpuScene& gpu, std::uint32_t mesh, const gl::PipelineState& opaque,
                             std::uint32_t count, gl::CommandList& list, LightReport& report) {
    const GpuScene::MeshRange& range = gpu.mesh(mesh);
    const auto draw = [&](const gl::PipelineState& state, std::uint32_t first_index, std::uint32_t index_count) {
        if (!(pipeline_ == state)) list.add(gl::SetPipeline{state});
        pipeline_ = state;
        list.add(gl::DrawMeshes{first_index, index_count, range.base_vertex, next_item_, count});
        ++report.draws;
        report.triangles += std::uint64_t{index_count} / 3 * count;
    };
    // Opaque submeshes side by side are one draw; blended ones let light through and are left out.
    std::uint32_t first = 0, length = 0;
    const auto flush = [&] {
        if (length > 0) draw(opaque, first, length);
        length = 0;
    };
    for (std::uint32_t s = 0; s < range.submesh_count; ++s) {
        const GpuScene::SubmeshRange& submesh = gpu.submesh(range.first_submesh + s);
        const GpuScene::MaterialInfo& material = gpu.material(submesh.material);
        if (material.alpha_mode == assets::AlphaMode::opaque && length > 0 && first + length == submesh.first_index) {
            length += submesh.index_count;
            continue;
        }
        flush();
        if (material.alpha_mode == assets::AlphaMode::opaque) {
            first = submesh.first_index;
            length = submesh.index_count;
        } else if (material.alpha_mode == assets::AlphaMode::mask) {
            list.add(gl::BindTexture{0, material.texture, material.sampler});
            list.add(gl::BindUniforms{2, gpu.material_uniforms(), material.uniform_offset, sizeof(MaterialRecord)});
            draw(depth_state(programs_[kMasked]), submesh.first_index, submesh.index_count);
        }
    }
    flush();
}

void DepthRecorder::draw_view(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame,
                              const ShadowView& view, gl::CommandList& list, LightReport& report) {
    const auto casters = std::span(frame.view_caster_items).subspan(view.casters.first, view.casters.count);
    pipeline_ = {};
    for_each_mesh_run(scene, casters, [&](std::uint32_t mesh, std::uint32_t first, std::uint32_t count) {
        draw_run(gpu, mesh, opaque_state(scene, gpu, view, casters.subspan(first, count)), count, list, report);
        next_item_ += count;
    });
}

void DepthRecorder::record(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame, gl::CommandList& list,
                           FrameReport& report) {
    const std::uint32_t stride = aligned(sizeof(DepthViewRecord), device_.info().uniform_alignment);
    item_scratch_.clear();
    view_scratch_.clear();
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        if (!is_drawn(frame, v)) continue;
        const ShadowView& view = frame.views[v];
        for (std::uint32_t i = 0; i < view.casters.count; ++i)
            item_scratch_.push_back({scene.instances[frame.view_caster_items[view.casters.first + i]].gpu_slot, 0});
        const math::TwoFloat3 anchor = math::split(view.anchor_ws_m);
        const DepthViewRecord record{view.clip_from_anchor, glm::vec4(anchor.high, 0.0f), glm::vec4(anchor.low, 0.0f)};
        view_scratch_.resize(view_scratch_.size() + stride);
        std::memcpy(view_scratch_.data() + view_scratch_.size() - stride, &record, sizeof record);
    }
    if (view_scratch_.empty()) return;
    list.update(items_.handle(), 0, std::span<const DrawItem>(item_scratch_));
    list.update(views_.handle(), 0, std::span<const std::byte>(view_scratch_));

    next_item_ = 0;
    std::uint32_t view_offset = 0;
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        if (!is_drawn(frame, v)) continue;
        const ShadowView& view = frame.views[v];
        const ShadowSlot& slot = frame.slots[v];
        const std::uint32_t light = frame.demands[view.demand].light;
        const LightTime time(frame, light);
        LightReport& light_report = report.lights[light];
        const auto size = static_cast<std::int32_t>(slot.size_px);
        list.add(gl::BeginGroup{"shadow " + scene.lights[light].name + " " + std::to_string(view.layer)});
        list.add(gl::BeginTimer{shadow_timer(light)});
        list.add(gl::BeginPass{slot.target, {0, 0, size, size}, true, 0.0f, false, {}});
        list.add(gl::BindUniforms{0, views_.handle(), view_offset, sizeof(DepthViewRecord)});
        list.add(gl::BindStorage{0, gpu.instances()});
        list.add(gl::BindMeshes{gpu.vertices(), gpu.indices(), items_.handle()});
        draw_view(scene, gpu, frame, view, list, light_report);
        list.add(gl::EndPass{});
        list.add(gl::EndTimer{shadow_timer(light)});
        list.add(gl::EndGroup{});
        ++light_report.clears;
        ++light_report.views_drawn;
        view_offset += stride;
    }
}

}  // namespace gnomon::shadow
