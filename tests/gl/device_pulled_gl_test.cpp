#include <glm/vec2.hpp>

#include "tests/gl/device_fixture.h"

namespace gnomon {
namespace {

class DevicePulled : public DeviceTest {};

TEST_F(DevicePulled, TrianglesAreMadeOfNothingButTheirVertexNumbers) {
    // Vertex n of a strip of quads, one per column of the target.
    const gl::ProgramHandle program = keep(device().create_program(
        {.label = "columns",
         .vertex = "#version 450 core\nvoid main() { int quad = gl_VertexID / 6, corner = gl_VertexID % 6;\n"
                   "float x = float(quad + int(corner == 1 || corner == 3 || corner == 4)) / 8.0 - 1.0;\n"
                   "float y = corner == 2 || corner == 4 || corner == 5 ? 1.0 : -1.0;\n"
                   "gl_Position = vec4(x, y, 0.5, 1.0); }\n",
         .fragment =
             "#version 450 core\nlayout(location = 0) out vec4 result;\nvoid main() { result = vec4(1.0); }\n"}));
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program}});
    list.add(gl::DrawPulled{2 * 6, 3 * 6});
    list.add(gl::EndPass{});
    run(list);
    const auto image = pixels();
    for (std::uint32_t x = 0; x < kSize_px; ++x) EXPECT_EQ(at(image, x, 8)[0], x >= 2 && x < 5 ? 255 : 0) << x;
}

TEST_F(DevicePulled, PointsAreSquaresOfTheSizeThatTheirVertexSays) {
    ASSERT_GE(device().info().max_point_px, 6u);
    // The square is around (4.5, 7), 5 pixels wide: columns 2 to 6, and 4.5 to 9.5 in rows. The draw leaves out the
    // first two vertices; the fourth lies beside the target. NVIDIA draws the part of a point that lies in it, too.
    const gl::ProgramHandle program = keep(device().create_program(
        {.label = "points",
         .vertex = "#version 450 core\nvoid main() { vec2 at = gl_VertexID == 2 ? vec2(4.5, 7.0) : vec2(24.0, 3.0);\n"
                   "if (gl_VertexID < 2) at = vec2(12.5);\n"
                   "gl_PointSize = gl_VertexID == 2 ? 5.0 : 6.0; gl_Position = vec4(at / 8.0 - 1.0, 0.5, 1.0); }\n",
         .fragment =
             "#version 450 core\nlayout(location = 0) out vec4 result;\nvoid main() { result = vec4(1.0); }\n"}));
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program}});
    list.add(gl::DrawPoints{2, 2});
    list.add(gl::EndPass{});
    run(list);
    const auto image = pixels();
    for (std::uint32_t y = 0; y < kSize_px; ++y)
        for (std::uint32_t x = 0; x < kSize_px; ++x) {
            const bool inside = x >= 2 && x <= 6 && y >= 5 && y <= 8;
            const bool on_border = x >= 2 && x <= 6 && (y == 4 || y == 9);  // their middles lie on the square's sides
            if (on_border) continue;
            EXPECT_EQ(at(image, x, y)[0], inside ? 255 : 0) << x << ' ' << y;
        }
}

TEST_F(DevicePulled, OfEachChannelTheLargerValueStays) {
    const auto colours = keep(device().create_texture(
        {.label = "two", .format = gl::Format::rg32f, .width = kSize_px, .height = kSize_px}, {}));
    const auto into = keep(device().create_target({.label = "two", .colours = {{colours}}}));
    const auto writes = [&](const char* value) {
        return full_screen(std::string("result = vec4(") + value + ", 0.0, 0.0);");
    };
    gl::CommandList list;
    list.add(gl::BeginPass{
        .target = into, .viewport = {0, 0, kSize_px, kSize_px}, .clear_colour = true, .colour = {-1.0f, 0.25f}});
    for (const char* value : {"-0.5, 0.125", "-7.0, 3.5", "-0.75, 1.0"}) {
        list.add(gl::SetPipeline{{.program = writes(value), .blend = gl::Blend::largest}});
        list.add(gl::DrawTriangle{});
    }
    // What is drawn next adds again.
    list.add(gl::SetPipeline{{.program = writes("0.25, -0.5"), .blend = gl::Blend::add}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    for (const glm::vec2& value : read<glm::vec2>(colours, kTexels)) EXPECT_EQ(value, glm::vec2(-0.25f, 3.0f));
}

}  // namespace
}  // namespace gnomon
