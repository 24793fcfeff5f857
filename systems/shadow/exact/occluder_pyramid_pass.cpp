#include "systems/shadow/exact/occluder_pyramid_pass.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "shaders/bindings.h"
#include "shaders/embedded.h"
#include "systems/frame_timers.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {
namespace {

/// Squares that a work group makes along an edge, as in shaders/shadow/passes/bounds/occluder_pyramid.comp.
constexpr std::uint32_t kGroup = 8;

bool has_pyramid(const DrawnViews& drawn, std::size_t v) { return drawn.is_drawn(v) && drawn.maps[v].sheets.ends; }

std::uint32_t levels_of(std::uint32_t size_px) {
    std::uint32_t levels = 1;
    for (PyramidLevel level = first_pyramid_level(size_px); level.side > 1; level = next_pyramid_level(level)) ++levels;
    return levels;
}

glm::ivec4 place_of(const PyramidLevel& level, std::uint32_t before) {
    return {static_cast<std::int32_t>(before + level.first), static_cast<std::int32_t>(level.side), 0, 0};
}

double size_of(const FilterSettings& filter, const ShadowView& view) {
    const bool parallel = is_parallel(view);
    return static_cast<double>(parallel ? filter.sun_radius_tan : filter.source_radius_m);
}

}  // namespace

OccluderPyramidPass::OccluderPyramidPass(gl::Device& device, bool with_margins)
    : device_(device), with_margins_(with_margins), records_(device, "shadow sheet ends") {}

OccluderPyramidPass::~OccluderPyramidPass() {
    for (const Program& p : programs_) device_.destroy(p.program);
}

OccluderPyramidPass::Source OccluderPyramidPass::first_source(const ShadowView& view) {
    return view.projection == ViewProjection::cube_face ? Source::cube : Source::map;
}

bool OccluderPyramidPass::program(Source source) {
    Program& made = programs_[static_cast<std::size_t>(source)];
    if (made.program) return true;
    if (!made.retry.due(frame_)) return false;
    std::vector<std::string> defines;
    if (source == Source::level) defines.emplace_back("OF_LEVEL 1");
    if (source == Source::cube) defines.emplace_back("CUBE 1");
    if (!with_margins_) defines.emplace_back("SHEETS_WITHOUT_MARGINS 1");
    const auto text = gl::expand_shader(shader_files(), "shadow/passes/bounds/occluder_pyramid.comp", defines);
    const char* const label = source == Source::level ? "sheet ends" : "sheet ends of texels";
    if (text) made.program = device_.create_program({.label = label, .compute = text.value()}).handle;
    if (!made.program) made.retry.failed(frame_);
    return static_cast<bool>(made.program);
}

void OccluderPyramidPass::prepare(const PassInputs& in, const LightAccounts& accounts) {
    ++frame_;
    std::size_t records = 0;
    for (std::size_t v = 0; v < in.drawn.count(); ++v) {
        if (!has_pyramid(in.drawn, v)) continue;
        if (program(first_source(in.drawn.view(v))) && program(Source::level))
            records += levels_of(in.drawn.maps[v].size_px);
        else
            accounts.statuses[in.drawn.view(v).light].lose_maps(Reason::depth_program_failed, true);
    }
    if (records == 0 || records_.reserve(records * aligned(sizeof(PyramidRecord), device_.info().uniform_alignment)))
        return;
    for (std::size_t v = 0; v < in.drawn.count(); ++v)
        if (has_pyramid(in.drawn, v)) accounts.statuses[in.drawn.view(v).light].lose_maps(Reason::buffer_failed, true);
}

void OccluderPyramidPass::append_records(const DrawnViews& drawn, std::size_t v) {
    const ShadowView& view = drawn.view(v);
    const ShadowRequest& request = drawn.lights[view.light].request;
    const std::uint32_t size_px = drawn.maps[v].size_px, before = view.layer * pyramid_count(size_px);
    // A map that was shrunk has larger texels than the fit planned.
    const double stretch = static_cast<double>(request.map.resolution_px) / static_cast<double>(size_px);
    const double texel_u = view.plane.texel_u * stretch, texel_v = view.plane.texel_v * stretch;
    const bool parallel = is_parallel(view);
    PyramidRecord record;
    if (view.projection == ViewProjection::cube_face) {
        const CubeFace& face = cube_face(view.layer);
        record.axis_u = glm::vec4(glm::vec3(face.axis_u), 0.0f);
        record.axis_v = glm::vec4(glm::vec3(face.axis_v), 0.0f);
        record.axis_back = glm::vec4(glm::vec3(face.axis_back), 0.0f);
    }
    record.numbers = {parallel ? 0.0f : static_cast<float>(std::max(texel_u, texel_v)),
                      static_cast<float>(view.depth.alpha),
                      static_cast<float>(steepest(view, texel_u, texel_v, size_of(request.map.filtering, view))), 0.0f};
    const auto append = [&] {
        const std::size_t at = record_scratch_.size();
        record_scratch_.resize(at + aligned(sizeof record, device_.info().uniform_alignment));
        std::memcpy(record_scratch_.data() + at, &record, sizeof record);
    };
    const auto layer = static_cast<std::int32_t>(view.layer);
    record.from = {0, static_cast<std::int32_t>(size_px), layer, 0};
    PyramidLevel level = first_pyramid_level(size_px);
    for (;; level = next_pyramid_level(level)) {
        record.to = place_of(level, before);
        append();
        if (level.side == 1) return;
        record.from = record.to;
    }
}

void OccluderPyramidPass::record_view(const PassInputs& in, std::size_t v, std::uint32_t& offset,
                                      gl::CommandList& list) {
    const ShadowView& view = in.drawn.view(v);
    const MapAssignment& map = in.drawn.maps[v];
    list.add(gl::BeginGroup{{"sheet ends", in.scene.lights[view.light].name, std::to_string(view.layer)}});
    list.add(gl::BeginTimer{shadow_timer(view.light)});
    list.add(gl::BindTexture{bindings::kShadowMapUnit, map.texture, {}});
    list.add(gl::BindTexture{bindings::kBoundsUnit, map.sheets.bounds, {}});
    list.add(gl::BindStorage{bindings::kPyramidBuffer, map.sheets.ends});
    Source source = first_source(view);
    PyramidLevel level = first_pyramid_level(map.size_px);
    for (;; level = next_pyramid_level(level), source = Source::level) {
        const std::uint32_t groups = (level.side + kGroup - 1) / kGroup;
        list.add(gl::BindUniforms{bindings::kPyramidBlock, records_.handle(), offset, sizeof(PyramidRecord)});
        list.add(gl::Dispatch{programs_[static_cast<std::size_t>(source)].program, groups, groups});
        offset += aligned(sizeof(PyramidRecord), device_.info().uniform_alignment);
        if (level.side == 1) break;
    }
    list.add(gl::EndTimer{shadow_timer(view.light)});
    list.add(gl::EndGroup{});
}

void OccluderPyramidPass::record(const PassInputs& in, const PassOutputs& out) {
    record_scratch_.clear();
    for (std::size_t v = 0; v < in.drawn.count(); ++v)
        if (has_pyramid(in.drawn, v)) append_records(in.drawn, v);
    if (record_scratch_.empty()) return;
    out.list.update(records_.handle(), 0, std::span<const std::byte>(record_scratch_));
    std::uint32_t offset = 0;
    for (std::size_t v = 0; v < in.drawn.count(); ++v) {
        if (!has_pyramid(in.drawn, v)) continue;
        const LightTimer time(out.cpu_us, in.drawn.view(v).light);
        record_view(in, v, offset, out.list);
    }
}

}  // namespace gnomon::shadow
