#include "systems/debug/debug_painter.h"

#include <algorithm>

#include "shaders/embedded.h"

namespace gnomon::debug {
namespace {

/// The part of `area` that lies in a picture of `size_px`; all of it if `area` has no width.
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

gl::ProgramHandle DebugPainter::program(std::string_view fragment) {
    auto found =
        std::find_if(programs_.begin(), programs_.end(), [&](const Program& p) { return p.fragment == fragment; });
    if (found == programs_.end()) found = programs_.insert(programs_.end(), {fragment});
    if (found->handle || !found->retry.due(records_)) return found->handle;
    const auto v = gl::expand_shader(shader_files(), "shared/fullscreen.vert", {});
    const auto f = gl::expand_shader(shader_files(), fragment, {});
    if (v && f) found->handle = device_.create_program({std::string(fragment), v.value(), f.value()}).handle;
    if (!found->handle) found->retry.failed(records_);
    return found->handle;
}

void DebugPainter::record(const Request& request, const SceneSnapshot& scene, const shadow::ShadowFrame& frame,
                          gl::TargetHandle target, glm::uvec2 size_px, gl::CommandList& list) {
    labels_.clear();
    if (!request.view) return;
    ++records_;
    const gl::Rect area = within(request.area, size_px);
    if (area.width <= 0 || area.height <= 0) return;
    std::optional<Drawing> drawing = request.view->draw({scene, frame, request, area});
    if (!drawing) return;
    if (!raw_) raw_ = device_.create_sampler({.label = "debug raw"}).handle;
    const gl::ProgramHandle used = program(request.view->fragment);
    if (!raw_ || !used || !block_.reserve(drawing->block.size())) return;

    list.add(gl::BeginGroup{"debug " + std::string(request.view->name)});
    list.update(block_.handle(), 0, std::span<const std::byte>(drawing->block));
    list.add(gl::BeginPass{.target = target, .viewport = area});
    list.add(gl::SetPipeline{{.program = used}});
    list.add(gl::BindUniforms{0, block_.handle(), 0, static_cast<std::uint32_t>(drawing->block.size())});
    for (std::uint32_t unit = 0; unit < drawing->maps.size(); ++unit)
        if (drawing->maps[unit]) list.add(gl::BindTexture{unit, drawing->maps[unit], raw_});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    list.add(gl::EndGroup{});
    labels_ = std::move(drawing->labels);
}

}  // namespace gnomon::debug
