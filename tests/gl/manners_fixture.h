#pragma once
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/gl/device_gl45.h"
#include "engine/platform/context.h"

namespace gnomon {

using Heard = std::vector<std::string>;
inline void GLAPIENTRY hear(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text, const void* to) {
    if (type == GL_DEBUG_TYPE_ERROR) const_cast<Heard*>(static_cast<const Heard*>(to))->emplace_back(text);
}

/// A context of an engine with a callback for errors, and a device that shares it.
class Manners : public ::testing::Test {
protected:
    void SetUp() override {
        auto made = platform::make_headless_context(true);
        ASSERT_TRUE(made) << to_line(made.error());
        context = std::move(made).value();
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(hear, &heard);
        make(true);
    }
    void TearDown() override {
        device.reset();
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR}) << "an error leaked out";
        context.reset();
    }
    void make(bool keeps_state, gl::MessageSink sink = {}) {
        device.reset();
        auto made = gl::make_gl45_device(std::move(sink), {.keeps_state = keeps_state});
        ASSERT_TRUE(made);
        device = std::move(made).value();
        colour = device->create_texture({.label = "colour", .width = 4, .height = 4}, {}).handle;
        target = device->create_target({.label = "target", .colours = {{colour}}}).handle;
        program = device->create_program({.label = "program", .vertex = kVertex, .fragment = kFragment}).handle;
        uniforms = device->create_buffer({.label = "uniforms", .size = 256}, {}).handle;
        ASSERT_TRUE(colour && target && program && uniforms);
    }
    /// Returns one pass with one draw.
    gl::CommandList small_list() const {
        gl::CommandList list;
        list.add(gl::BeginPass{.target = target, .viewport = {0, 0, 4, 4}, .clear_colour = true});
        list.add(gl::SetPipeline{{.program = program}});
        list.add(gl::BindUniforms{1, uniforms, 0, 256});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        return list;
    }
    /// Returns a list that raises an error of OpenGL's own: copies between sample counts do not exist.
    gl::CommandList erroneous_list() {
        GLuint name = 0;
        glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &name);
        glTextureStorage2DMultisample(name, 4, GL_RGBA8, 4, 4, GL_TRUE);
        const auto samples = gl::import_texture(*device, name, {.width = 4, .height = 4});
        EXPECT_TRUE(samples);
        gl::CommandList list;
        list.add(gl::CopyTexture{samples, colour, 0});
        return list;
    }

    static constexpr const char* kVertex = R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0); }
)";
    static constexpr const char* kFragment = R"(#version 450 core
layout(std140, binding = 1) uniform Block { vec4 value; };
layout(location = 0) out vec4 result;
void main() { result = value; }
)";
    Heard heard;
    std::unique_ptr<platform::Context> context;
    std::unique_ptr<gl::Device> device;
    gl::TextureHandle colour;
    gl::TargetHandle target;
    gl::ProgramHandle program;
    gl::BufferHandle uniforms;
};

}  // namespace gnomon
