#include "systems/shadow/exact/bounds_pass.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "engine/math/projection.h"
#include "shaders/embedded.h"
#include "systems/frame_timers.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/update/drawn_views.h"

namespace gnomon::shadow {
namespace {

/// Corners of a quad's two triangles.
constexpr std::uint32_t kQuadVertices = 6;
/// Texture units of shaders/shadow/passes/bounds/bounds_item.glsl.
constexpr std::uint32_t kItemUnit = 12, kVertexUnit = 13;
static_assert(sizeof(assets::Vertex) == 2 * gl::kTexelBytes && sizeof(SheetItem) == gl::kTexelBytes);
/// Nothing ends there: behind all that depth can be.
constexpr float kNoContour = -1.0f;

bool is_small(std::size_t which) { return which >= SheetItems::kinds; }

bool is_bounded(const ShadowFrame& frame, std::size_t view) {
    return is_drawn(frame, view) && frame.slots[view].bounds_target;
}

}  // namespace

SheetRecorder::SheetRecorder(gl::Device& device, const Options& options)
    : device_(device),
      with_margins_(options.with_margins),
      gatherer_(options.with_points ? device.info().max_point_px : 0),
      items_(device, "shadow sheet items", true),
      view_records_(device, "shadow sheet views") {}

SheetRecorder::~SheetRecorder() {
    for (const Program& p : programs_) device_.destroy(p.program);
}

void SheetRecorder::release() {
    items_.release();
    view_records_.release();
    surfaces_.clear();
}

bool SheetRecorder::program(std::size_t which) {
    Program& made = programs_[which];
    if (made.program) return true;
    if (!made.retry.due(frame_)) return false;
    const std::size_t kind = which % SheetItems::kinds;
    const bool contours = kind == SheetItems::contours, points = is_small(which);
    std::vector<std::string> defines;
    if (kind == SheetItems::masked) defines.emplace_back("MASKED 1");
    if (points) defines.emplace_back("AS_POINTS 1");
    if (!with_margins_) defines.emplace_back("SHEETS_WITHOUT_MARGINS 1");
    const char* const name = contours ? "shadow/passes/bounds/silhouettes" : "shadow/passes/bounds/depth_range";
    const auto vertex = gl::expand_shader(shader_files(), std::string(name) + ".vert", defines);
    const auto fragment = gl::expand_shader(shader_files(), std::string(name) + ".frag", defines);
    constexpr const char* kLabels[] = {"sheet departures", "sheet contours", "sheet masks"};
    const std::string label = std::string(kLabels[kind]) + (points ? ", small" : "");
    if (vertex && fragment)
        made.program = device_.create_program({label.c_str(), vertex.value(), fragment.value()}).handle;
    if (!made.program) made.retry.failed(frame_);
    return static_cast<bool>(made.program);
}

/// Of a kind both, lest a frame be late once a camera comes so near that something is large.
bool SheetRecorder::programs_ready(const View& view) {
    bool ready = true;
    for (std::size_t kind = 0; kind < SheetItems::kinds; ++kind) {
        const std::size_t small = kind + SheetItems::kinds;
        if (view.count[kind] + view.count[small] == 0) continue;
        ready = program(kind) && (!gatherer_.draws_points() || program(small)) && ready;
    }
    return ready;
}

SheetRecorder::View SheetRecorder::gather(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame,
                                          std::size_t v) {
    const ShadowView& view = frame.views[v];
    view_scratch_.clear();
    for (const std::uint32_t i : std::span(frame.view_caster_items).subspan(view.casters.first, view.casters.count)) {
        const InstanceItem& item = scene.instances[i];
        gatherer_.append(gpu, surfaces_.of(gpu, item.mesh), item, view, frame.slots[v].size_px, view_scratch_);
    }
    View found;
    found.view = v;
    for (std::size_t which = 0; which < kPrograms; ++which) {
        const std::vector<SheetItem>& items =
            is_small(which) ? view_scratch_.small[which - SheetItems::kinds] : view_scratch_.large[which];
        found.first[which] = static_cast<std::uint32_t>(item_scratch_.size());
        found.count[which] = static_cast<std::uint32_t>(items.size());
        item_scratch_.insert(item_scratch_.end(), items.begin(), items.end());
    }
    return found;
}

void SheetRecorder::prepare(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame) {
    ++frame_;
    views_.clear();
    item_scratch_.clear();
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        if (!is_bounded(frame, v)) continue;
        const LightTime time(frame, frame.demands[frame.views[v].demand].light);
        const View view = gather(scene, gpu, frame, v);
        if (programs_ready(view))
            views_.push_back(view);
        else
            drop_light(frame, frame.views[v].demand, Reason::depth_program_failed);
    }
    if (views_.empty()) return;
    const std::uint32_t stride = aligned(sizeof(DepthViewRecord), device_.info().uniform_alignment);
    if (items_.reserve(std::max<std::size_t>(item_scratch_.size(), 1) * sizeof(SheetItem)) &&
        view_records_.reserve(views_.size() * stride))
        return;
    for (const View& view : views_) drop_light(frame, frame.views[view.view].demand, Reason::buffer_failed);
    views_.clear();
}

void SheetRecorder::record_view(const SceneSnapshot& scene, const GpuScene& gpu, const ShadowFrame& frame,
                                const View& drawn, std::uint32_t offset, gl::CommandList& list, LightReport& report) {
    const ShadowView& view = frame.views[drawn.view];
    const ShadowSlot& slot = frame.slots[drawn.view];
    const ShadowDemand& demand = frame.demands[view.demand];
    const auto size = static_cast<std::int32_t>(slot.size_px);
    const SheetFloor floor = sheet_floor(view, slot.size_px);
    const float cleared = with_margins_ ? floor.cleared : static_cast<float>(floor.departure);
    list.add(gl::BeginGroup{{"sheets", scene.lights[demand.light].name, std::to_string(view.layer)}});
    list.add(gl::BeginTimer{shadow_timer(demand.light)});
    list.add(
        gl::BeginPass{slot.bounds_target, {0, 0, size, size}, false, 0.0f, true, {kNoContour, cleared, 0.0f, 0.0f}});
    list.add(gl::BindUniforms{0, view_records_.handle(), offset, sizeof(DepthViewRecord)});
    list.add(gl::BindTexels{kInstanceUnit, gpu.instances()});
    list.add(gl::BindTexels{kVertexUnit, gpu.vertices()});
    list.add(gl::BindTexels{kItemUnit, items_.handle()});
    for (std::size_t which = 0; which < kPrograms; ++which) {
        const std::uint32_t first = drawn.first[which], count = drawn.count[which];
        if (count == 0) continue;
        gl::PipelineState state{.program = programs_[which].program};
        state.blend = gl::Blend::largest;
        list.add(gl::SetPipeline{state});
        if (is_small(which))
            list.add(gl::DrawPoints{first, count});
        else
            list.add(gl::DrawPulled{first * kQuadVertices, count * kQuadVertices});
        ++report.draws;
        report.triangles += (is_small(which) ? 1 : 2) * std::uint64_t{count};
    }
    list.add(gl::EndPass{});
    list.add(gl::EndTimer{shadow_timer(demand.light)});
    list.add(gl::EndGroup{});
}

void SheetRecorder::record(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame, gl::CommandList& list,
                           FrameReport& report) {
    // What another recorder dropped meanwhile is not drawn.
    std::erase_if(views_, [&](const View& view) { return !is_bounded(frame, view.view); });
    if (views_.empty()) return;
    const std::uint32_t stride = aligned(sizeof(DepthViewRecord), device_.info().uniform_alignment);
    record_scratch_.assign(views_.size() * stride, std::byte{});
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const ShadowView& view = frame.views[views_[i].view];
        const math::TwoFloat3 anchor = math::split(view.anchor_ws_m);
        const DepthViewRecord record{view.clip_from_anchor,
                                     glm::vec4(anchor.high, static_cast<float>(frame.slots[views_[i].view].size_px)),
                                     glm::vec4(anchor.low, static_cast<float>(view.layer))};
        std::memcpy(record_scratch_.data() + i * stride, &record, sizeof record);
    }
    if (!item_scratch_.empty()) list.update(items_.handle(), 0, std::span<const SheetItem>(item_scratch_));
    list.update(view_records_.handle(), 0, std::span<const std::byte>(record_scratch_));
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const std::uint32_t light = frame.demands[frame.views[views_[i].view].demand].light;
        const LightTime time(frame, light);
        record_view(scene, gpu, frame, views_[i], static_cast<std::uint32_t>(i) * stride, list, report.lights[light]);
    }
}

}  // namespace gnomon::shadow
