#include "systems/shadow/exact/bounds_pass.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "engine/math/projection.h"
#include "shaders/bindings.h"
#include "shaders/embedded.h"
#include "systems/frame_timers.h"
#include "systems/shadow/frame/cpu_timer.h"

namespace gnomon::shadow {
namespace {

/// Corners of a quad's two triangles.
constexpr std::uint32_t kQuadVertices = 6;
static_assert(sizeof(assets::Vertex) == 2 * gl::kTexelBytes && sizeof(BoundsItem) == gl::kTexelBytes);
/// Cleared depth of silhouette edges: there is none. Behind any depth.
constexpr float kNoContour = -1.0f;

bool is_small(std::size_t which) { return which >= BoundsItems::kinds; }

bool is_bounded(const DrawnViews& drawn, std::size_t view) {
    return drawn.is_drawn(view) && drawn.maps[view].sheets.bounds_target;
}

}  // namespace

BoundsPass::BoundsPass(gl::Device& device, const Options& options)
    : device_(device),
      with_margins_(options.with_margins),
      gatherer_(options.with_points ? device.info().max_point_px : 0),
      items_(device, "shadow sheet items", true),
      view_records_(device, "shadow sheet views") {}

BoundsPass::~BoundsPass() {
    for (const Program& p : programs_) device_.destroy(p.program);
}

void BoundsPass::release() {
    items_.release();
    view_records_.release();
    surfaces_.clear();
}

bool BoundsPass::program(std::size_t which) {
    Program& made = programs_[which];
    if (made.program) return true;
    if (!made.retry.due(frame_)) return false;
    const std::size_t kind = which % BoundsItems::kinds;
    const bool contours = kind == BoundsItems::contours, points = is_small(which);
    std::vector<std::string> defines;
    if (kind == BoundsItems::masked) defines.emplace_back("MASKED 1");
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

/// Compiles the programs that the view needs. Both variants of a kind are compiled at once, so that a close-up with
/// large items does not stall on the second.
bool BoundsPass::programs_ready(const View& view) {
    bool ready = true;
    for (std::size_t kind = 0; kind < BoundsItems::kinds; ++kind) {
        const std::size_t small = kind + BoundsItems::kinds;
        if (view.count[kind] + view.count[small] == 0) continue;
        ready = program(kind) && (!gatherer_.draws_points() || program(small)) && ready;
    }
    return ready;
}

BoundsPass::View BoundsPass::gather(const PassInputs& in, std::size_t v) {
    const ShadowView& view = in.drawn.view(v);
    view_scratch_.clear();
    for (const std::uint32_t i : in.drawn.fitted.casters_of(view)) {
        const InstanceItem& item = in.scene.instances[i];
        gatherer_.append(in.gpu, surfaces_.of(in.gpu, item.mesh), item, view, in.drawn.maps[v].size_px, view_scratch_);
    }
    View found;
    found.view = v;
    for (std::size_t which = 0; which < kPrograms; ++which) {
        const std::vector<BoundsItem>& items =
            is_small(which) ? view_scratch_.small[which - BoundsItems::kinds] : view_scratch_.large[which];
        found.first[which] = static_cast<std::uint32_t>(item_scratch_.size());
        found.count[which] = static_cast<std::uint32_t>(items.size());
        item_scratch_.insert(item_scratch_.end(), items.begin(), items.end());
    }
    return found;
}

void BoundsPass::prepare(const PassInputs& in, const LightAccounts& accounts) {
    ++frame_;
    views_.clear();
    item_scratch_.clear();
    for (std::size_t v = 0; v < in.drawn.count(); ++v) {
        if (!is_bounded(in.drawn, v)) continue;
        const std::uint32_t light = in.drawn.view(v).light;
        const LightTimer time(accounts.cpu_us, light);
        const View view = gather(in, v);
        if (programs_ready(view))
            views_.push_back(view);
        else
            accounts.statuses[light].lose_maps(Reason::depth_program_failed, true);
    }
    if (views_.empty()) return;
    const std::uint32_t stride = aligned(sizeof(DepthViewRecord), device_.info().uniform_alignment);
    if (items_.reserve(std::max<std::size_t>(item_scratch_.size(), 1) * sizeof(BoundsItem)) &&
        view_records_.reserve(views_.size() * stride))
        return;
    for (const View& view : views_)
        accounts.statuses[in.drawn.view(view.view).light].lose_maps(Reason::buffer_failed, true);
    views_.clear();
}

void BoundsPass::record_view(const PassInputs& in, const View& drawn, std::uint32_t offset, gl::CommandList& list,
                             LightReport& report) {
    const ShadowView& view = in.drawn.view(drawn.view);
    const MapAssignment& map = in.drawn.maps[drawn.view];
    const auto size = static_cast<std::int32_t>(map.size_px);
    const BoundsFloor floor = bounds_floor(view, map.size_px);
    const float cleared = with_margins_ ? floor.cleared : static_cast<float>(floor.departure);
    list.add(gl::BeginGroup{{"sheets", in.scene.lights[view.light].name, std::to_string(view.layer)}});
    list.add(gl::BeginTimer{shadow_timer(view.light)});
    list.add(gl::BeginPass{
        map.sheets.bounds_target, {0, 0, size, size}, false, 0.0f, true, {kNoContour, cleared, 0.0f, 0.0f}});
    list.add(gl::BindUniforms{bindings::kDepthViewBlock, view_records_.handle(), offset, sizeof(DepthViewRecord)});
    list.add(gl::BindTexels{bindings::kInstanceUnit, in.gpu.instances()});
    list.add(gl::BindTexels{bindings::kBoundsVertexUnit, in.gpu.vertices()});
    list.add(gl::BindTexels{bindings::kBoundsItemUnit, items_.handle()});
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
        ++report.counts.draws;
        ++report.counts.draw_commands;
        const std::uint64_t triangles = (is_small(which) ? 1 : 2) * std::uint64_t{count};
        report.counts.triangles += triangles;
        report.counts.full_triangles += triangles;
    }
    list.add(gl::EndPass{});
    list.add(gl::EndTimer{shadow_timer(view.light)});
    list.add(gl::EndGroup{});
}

void BoundsPass::record(const PassInputs& in, const PassOutputs& out) {
    // Views that lost their maps in another recorder are not drawn.
    std::erase_if(views_, [&](const View& view) { return !is_bounded(in.drawn, view.view); });
    if (views_.empty()) return;
    const std::uint32_t stride = aligned(sizeof(DepthViewRecord), device_.info().uniform_alignment);
    record_scratch_.assign(views_.size() * stride, std::byte{});
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const ShadowView& view = in.drawn.view(views_[i].view);
        const math::TwoFloat3 anchor = math::split(view.pose.anchor_ws_m);
        const DepthViewRecord record{view.clip_from_anchor,
                                     glm::vec4(anchor.high, static_cast<float>(in.drawn.maps[views_[i].view].size_px)),
                                     glm::vec4(anchor.low, static_cast<float>(view.layer))};
        std::memcpy(record_scratch_.data() + i * stride, &record, sizeof record);
    }
    if (!item_scratch_.empty()) out.list.update(items_.handle(), 0, std::span<const BoundsItem>(item_scratch_));
    out.list.update(view_records_.handle(), 0, std::span<const std::byte>(record_scratch_));
    for (std::size_t i = 0; i < views_.size(); ++i) {
        const std::uint32_t light = in.drawn.view(views_[i].view).light;
        const LightTimer time(out.cpu_us, light);
        record_view(in, views_[i], static_cast<std::uint32_t>(i) * stride, out.list, out.report.lights[light]);
    }
}

}  // namespace gnomon::shadow
