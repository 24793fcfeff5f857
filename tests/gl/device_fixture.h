#pragma once
#include <array>

#include "tests/gl/gl_test_context.h"

namespace gnomon {

constexpr std::uint32_t kSize_px = 16;
constexpr std::size_t kTexels = kSize_px * kSize_px;

/// A small colour target with float depth, and the programs that most device tests draw with.
class DeviceTest : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (HasFatalFailure()) return;
        colour = keep(device().create_texture({.label = "colour", .width = kSize_px, .height = kSize_px}, {}));
        depth = keep(device().create_texture(
            {.label = "depth", .format = gl::Format::d32f, .width = kSize_px, .height = kSize_px}, {}));
        target = keep(device().create_target({.label = "target", .colours = {{colour}}, .depth = {depth}}));
    }

    /// Makes a program with a triangle that covers the viewport at depth `z`, a GLSL expression, and fragments that run
    /// `body`.
    gl::ProgramHandle full_screen(const std::string& body, const std::string& declarations = "",
                                  const std::string& z = "0.5") {
        return keep(device().create_program(
            {.label = "full screen",
             .vertex = "#version 450 core\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, "
                       "gl_VertexID == 2 ? 3.0 : -1.0, " +
                       z + ", 1.0); }\n",
             .fragment = "#version 450 core\nlayout(location = 0) out vec4 result;\n" + declarations +
                         "\nvoid main() {\n" + body + "\n}\n"}));
    }

    static gl::BeginPass clearing(gl::TargetHandle into, std::array<float, 4> to = {}) {
        return {.target = into,
                .viewport = {0, 0, kSize_px, kSize_px},
                .clear_depth = true,
                .clear_colour = true,
                .colour = to};
    }
    static gl::BeginPass keeping(gl::TargetHandle into) {
        return {.target = into, .viewport = {0, 0, kSize_px, kSize_px}};
    }

    using Rgba = std::array<std::uint8_t, 4>;
    std::vector<Rgba> pixels() { return read<Rgba>(colour, kTexels); }
    static Rgba at(const std::vector<Rgba>& image, std::uint32_t x, std::uint32_t y) { return image[y * kSize_px + x]; }

    template <class T>
    gl::BufferHandle fixed_buffer(const std::vector<T>& values) {
        const auto bytes = std::as_bytes(std::span{values});
        return keep(
            device().create_buffer({.label = "fixed", .size = bytes.size(), .use = gl::BufferUse::fixed}, bytes));
    }

    gl::TextureHandle colour, depth;
    gl::TargetHandle target;
};

}  // namespace gnomon
