#include "systems/debug/debug_painter.h"

#include <algorithm>

#include "shaders/bindings.h"
#include "shaders/embedded.h"
#include "systems/lighting/lighting_system.h"

namespace gnomon::debug {
namespace {

/// Clips `area` to a picture of `size_px`; returns the whole picture if `area` has no width.
gl::Rect within(const gl::Rect& area, glm::uvec2 size_px) {
    const glm::ivec2 size(size_px);
    if (area.width <= 0) return {0, 0, size.x, size.y};
    const glm::ivec2 low = glm::clamp(glm::ivec2(area.x, area.y), glm::ivec2(0), size);
    const glm::ivec2 high = glm::clamp(glm::ivec2(area.x + area.width, area.y + area.height), low, size);
    return {low.x, low.y, high.x - low.x, high.y - low.y};
}

}  // namespace

DebugPainter::~DebugPainter() {
    for (const Program& p : programs_) device_.destroy(p.handle);
    device_.destroy(raw_);
}

gl::ProgramHandle DebugPainter::program(std::string_view vertex, std::string_view fragment) {
    auto found =
        std::find_if(programs_.begin(), programs_.end(), [&](const Program& p) { return p.fragment == fragment; });
    if (found == programs_.end()) found = programs_.insert(programs_.end(), {fragment});
    if (found->handle || !found->retry.due(records_)) return found->handle;
    const auto v = gl::expand_shader(shader_files(), vertex, {});
    const auto f = gl::expand_shader(shader_files(), fragment, {});
    if (v && f) found->handle = device_.create_program({std::string(fragment), v.value(), f.value()}).handle;
    if (!found->handle) found->retry.failed(records_);
    return found->handle;
}

bool DebugPainter::record_flat(const Drawing& drawing, const ViewRow& row, const gl::Rect& area,
                               gl::TargetHandle target, gl::CommandList& list) {
    if (!raw_) raw_ = device_.create_sampler({.label = "debug raw"}).handle;
    const gl::ProgramHandle used = program("common/fullscreen.vert", row.drawer->fragment);
    if (!raw_ || !used || !block_.reserve(drawing.block.size())) return false;
    list.update(block_.handle(), 0, std::span<const std::byte>(drawing.block));
    list.add(gl::BeginPass{.target = target, .viewport = area});
    list.add(gl::SetPipeline{{.program = used}});
    list.add(gl::BindUniforms{bindings::kFlatViewBlock, block_.handle(), 0,
                              static_cast<std::uint32_t>(drawing.block.size())});
    for (std::uint32_t unit = 0; unit < drawing.maps.size(); ++unit)
        if (drawing.maps[unit]) list.add(gl::BindTexture{bindings::kFlatMapsUnit + unit, drawing.maps[unit], raw_});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    return true;
}

bool DebugPainter::record_lines(const Drawing& drawing, const ViewRow& row, const gl::Rect& area,
                                const lighting::LightingSystem& picture, gl::CommandList& list) {
    if (drawing.lines.empty()) return true;
    const gl::ProgramHandle used = program("debug/lines.vert", row.drawer->fragment);
    if (!used || !lines_.reserve(drawing.lines.size() * sizeof(LineVertex))) return false;
    const gl::Rect whole = within({}, picture.size_px());
    list.update(lines_.handle(), 0, std::span<const LineVertex>(drawing.lines));
    list.add(gl::BeginPass{.target = picture.picture_target(), .viewport = whole});
    list.add(gl::SetScissor{area});
    list.add(gl::SetPipeline{{.program = used, .blend = gl::Blend::alpha}});
    picture.bind_surface_textures(list);
    list.add(gl::BindStorage{bindings::kLineBuffer, lines_.handle()});
    list.add(gl::DrawLines{static_cast<std::uint32_t>(drawing.lines.size())});
    list.add(gl::EndPass{});
    return true;
}

bool DebugPainter::record_medium(const Drawing& drawing, const ViewRow& row, const gl::Rect& area,
                                 const Subject& subject, gl::CommandList& list) {
    switch (row.drawer->medium) {
        case ViewMedium::flat:
            return record_flat(drawing, row, area, subject.picture.picture_target(), list);
        case ViewMedium::lines:
            return record_lines(drawing, row, area, subject.picture, list);
        case ViewMedium::lookups:
            break;
    }
    if (!block_.reserve(drawing.block.size())) return false;
    list.update(block_.handle(), 0, std::span<const std::byte>(drawing.block));
    return subject.picture.record_lookups({subject.frame.inputs.front(), drawing.light, row.drawer->fragment, area,
                                           block_.handle(), static_cast<std::uint32_t>(drawing.block.size())},
                                          subject.gpu, list);
}

void DebugPainter::record(const Request& request, const Subject& subject, gl::CommandList& list) {
    labels_.clear();
    if (!request.view) return;
    ++records_;
    const ViewRow& row = *request.view;
    const gl::Rect area = within(request.area, subject.picture.size_px());
    if (area.width <= 0 || area.height <= 0) return;
    std::optional<Drawing> drawing = row.drawer->draw({subject.scene, subject.frame, request, area, subject.fitted});
    if (!drawing) return;
    // The list is truncated again if the device lacks something.
    const std::size_t commands = list.commands.size(), bytes = list.bytes.size();
    list.add(gl::BeginGroup{"debug " + std::string(row.name)});
    const bool drawn = record_medium(*drawing, row, area, subject, list);
    list.add(gl::EndGroup{});
    if (drawn) {
        labels_ = std::move(drawing->labels);
    } else {
        list.commands.resize(commands);
        list.bytes.resize(bytes);
    }
}

}  // namespace gnomon::debug
