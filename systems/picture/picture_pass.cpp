#include "systems/picture/picture_pass.h"

#include <string>

#include "shaders/bindings.h"
#include "shaders/embedded.h"

namespace gnomon::picture {

gl::ProgramHandle make_program(gl::Device& device, std::string_view label, std::string_view fragment,
                               std::span<const std::string> defines) {
    const auto vertex_source = gl::expand_shader(shader_files(), "common/fullscreen.vert", {});
    const auto fragment_source = gl::expand_shader(shader_files(), fragment, defines);
    if (!vertex_source || !fragment_source) return {};
    return device.create_program({std::string(label), vertex_source.value(), fragment_source.value()}).handle;
}

void record_pass(const PicturePass& pass, glm::uvec2 size_px, gl::CommandList& list) {
    const gl::Rect all{0, 0, static_cast<std::int32_t>(size_px.x), static_cast<std::int32_t>(size_px.y)};
    list.add(gl::BeginPass{pass.target, all, false, 0.0f, pass.clears, {}});
    list.add(gl::SetPipeline{{pass.program, gl::CullMode::none, false, gl::DepthTest::off, false, false, pass.blend}});
    list.add(gl::BindTexture{bindings::kFinishedPictureUnit, pass.source, pass.sampler});
    if (pass.uniforms) list.add(gl::BindUniforms{bindings::kSampleBlock, pass.uniforms, 0, pass.uniform_bytes});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
}

}  // namespace gnomon::picture
