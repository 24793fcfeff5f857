#include <gmock/gmock.h>

#include "tests/gl/device_meshes_fixture.h"

namespace gnomon {
namespace {

using gl::Format;
using gl::TextureKind;
using ::testing::Each;
using ::testing::FloatEq;

using DeviceDraw = DeviceTest;

TEST_F(DeviceDraw, ATriangleCoversTheViewport) {
    const auto program = full_screen("result = vec4(1.0, 0.5, 0.0, 1.0);");
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    EXPECT_THAT(pixels(), Each(::testing::AnyOf(Rgba{255, 127, 0, 255}, Rgba{255, 128, 0, 255})));
}

TEST_F(DeviceDraw, WithoutTheDrawThePictureStaysClear) {
    gl::CommandList list;
    list.add(clearing(target, {0.0f, 1.0f, 0.0f, 1.0f}));
    list.add(gl::EndPass{});
    run(list);
    EXPECT_THAT(pixels(), Each(Rgba{0, 255, 0, 255}));
    EXPECT_THAT(read<float>(depth, kTexels), Each(0.0f));
}

TEST_F(DeviceDraw, DepthIsReversedZeroToOne) {
    const auto near = full_screen("result = vec4(1.0);", "", "0.75"),
               far = full_screen("result = vec4(0.0);", "", "0.25");
    const gl::PipelineState state{.depth_test = gl::DepthTest::greater_equal, .depth_write = true};
    gl::CommandList list;
    list.add(clearing(target));
    for (const gl::ProgramHandle program : {near, far}) {
        gl::PipelineState with = state;
        with.program = program;
        list.add(gl::SetPipeline{with});
        list.add(gl::DrawTriangle{});
    }
    list.add(gl::EndPass{});
    run(list);
    EXPECT_THAT(pixels(), Each(Rgba{255, 255, 255, 255})) << "what lies behind is not drawn over";
    EXPECT_THAT(read<float>(depth, kTexels), Each(FloatEq(0.75f))) << "clip depth is stored as it is";
}

TEST_F(DeviceDraw, DepthIsWrittenWithoutATestAndTestedWithoutWriting) {
    const auto low = full_screen("result = vec4(1.0);", "", "0.25"),
               high = full_screen("result = vec4(0.0);", "", "0.75");
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = high, .depth_write = true}});
    list.add(gl::DrawTriangle{});
    list.add(gl::SetPipeline{{.program = low, .depth_write = true}});
    list.add(gl::DrawTriangle{});
    list.add(gl::SetPipeline{{.program = high, .depth_test = gl::DepthTest::greater}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    EXPECT_THAT(read<float>(depth, kTexels), Each(FloatEq(0.25f)));
    EXPECT_THAT(pixels(), Each(Rgba{0, 0, 0, 0}));
}

TEST_F(DeviceDraw, DepthClampKeepsWhatLiesOutsideTheDepthRange) {
    const auto beyond = full_screen("result = vec4(1.0);", "", "1.5");
    for (const bool clamp : {false, true}) {
        gl::CommandList list;
        list.add(clearing(target));
        list.add(gl::SetPipeline{
            {.program = beyond, .depth_test = gl::DepthTest::greater, .depth_write = true, .depth_clamp = clamp}});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        run(list);
        EXPECT_THAT(read<float>(depth, kTexels), Each(clamp ? 1.0f : 0.0f));
    }
}

TEST_F(DeviceDraw, ClearingDepthIgnoresAPipelineThatDoesNotWriteIt) {
    const auto program = full_screen("result = vec4(1.0);");
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program, .depth_write = false}});
    list.add(gl::SetScissor{{0, 0, 1, 1}});
    list.add(gl::EndPass{});
    gl::BeginPass second = clearing(target);
    second.depth = 0.625f;
    list.add(second);
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    EXPECT_THAT(read<float>(depth, kTexels), Each(0.625f)) << "clears are whole, the draw after them writes no depth";
    EXPECT_THAT(pixels(), Each(Rgba{255, 255, 255, 255})) << "a new pass has no scissor";
}

TEST_F(DeviceDraw, ScissorLimitsDraws) {
    const auto program = full_screen("result = vec4(1.0);");
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program}});
    list.add(gl::SetScissor{{4, 2, 3, 5}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    const auto image = pixels();
    for (std::uint32_t y = 0; y < kSize_px; ++y) {
        for (std::uint32_t x = 0; x < kSize_px; ++x) {
            const bool inside = x >= 4 && x < 7 && y >= 2 && y < 7;
            EXPECT_EQ(at(image, x, y)[0], inside ? 255 : 0) << x << ',' << y;
        }
    }
}

TEST_F(DeviceDraw, BlendAddSumsAndAlphaMixes) {
    const auto add = full_screen("result = vec4(0.25, 0.25, 0.25, 0.25);"),
               mix = full_screen("result = vec4(1.0, 0.0, 0.0, 0.5);");
    const auto hdr = keep(
        device().create_texture({.label = "hdr", .format = Format::r32f, .width = kSize_px, .height = kSize_px}, {}));
    const auto hdr_target = keep(device().create_target({.label = "hdr", .colours = {{hdr}}}));
    gl::CommandList list;
    list.add(clearing(hdr_target, {1.0f, 0.0f, 0.0f, 0.0f}));
    list.add(gl::SetPipeline{{.program = add, .blend = gl::Blend::add}});
    list.add(gl::DrawTriangle{});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    list.add(clearing(target, {0.0f, 1.0f, 0.0f, 0.0f}));
    list.add(gl::SetPipeline{{.program = mix, .blend = gl::Blend::alpha}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    EXPECT_THAT(read<float>(hdr, kTexels), Each(1.5f));
    const Rgba mixed = at(pixels(), 3, 3);
    EXPECT_NEAR(mixed[0], 128, 1);
    EXPECT_NEAR(mixed[1], 128, 1);
}

TEST_F(DeviceDraw, CompareSamplersPassWhereTheReferenceReachesTheStoredDepth) {
    const std::vector<float> stored(kTexels, 0.5f);
    const auto map =
        keep(device().create_texture({.label = "map", .format = Format::d32f, .width = kSize_px, .height = kSize_px},
                                     std::as_bytes(std::span{stored})));
    const auto compare = keep(device().create_sampler(
        {.label = "compare", .linear = true, .compare = true, .wrap_u = gl::Wrap::border, .wrap_v = gl::Wrap::border}));
    const auto program = full_screen(
        "result = vec4(texture(map, vec3(0.5, 0.5, 0.501)), texture(map, vec3(0.5, 0.5, 0.499)),"
        " texture(map, vec3(0.5, 0.5, 0.5)), texture(map, vec3(5.0, 5.0, 0.001)));",
        "layout(binding = 2) uniform sampler2DShadow map;");
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program}});
    list.add(gl::BindTexture{2, map, compare});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    EXPECT_THAT(pixels(), Each(Rgba{255, 0, 255, 255})) << "above, below, equal, beyond the border (lit)";
}

// OpenGL's table of cube faces: a direction along an axis meets the middle of the face of that axis.
TEST_F(DeviceDraw, DirectionsAlongEachAxisMeetTheFaceOfThatAxis) {
    const auto cube = keep(device().create_texture(
        {.label = "cube", .kind = TextureKind::cube, .format = Format::d32f, .width = 8, .height = 8}, {}));
    gl::CommandList list;
    for (std::int32_t face = 0; face < 6; ++face) {
        const auto into = keep(device().create_target({.label = "face", .depth = {cube, face}}));
        list.add(gl::BeginPass{.target = into,
                               .viewport = {0, 0, 8, 8},
                               .clear_depth = true,
                               .depth = static_cast<float>(face + 1) / 8.0f});
        list.add(gl::EndPass{});
    }
    run(list);
    const std::array<const char*, 6> axes = {"1,0,0", "-1,0,0", "0,1,0", "0,-1,0", "0,0,1", "0,0,-1"};
    for (std::size_t face = 0; face < axes.size(); ++face) {
        const auto program = full_screen(std::string{"result = vec4(texture(map, vec3("} + axes[face] + ")).r);",
                                         "layout(binding = 0) uniform samplerCube map;");
        gl::CommandList draw;
        draw.add(clearing(target));
        draw.add(gl::SetPipeline{{.program = program}});
        draw.add(gl::BindTexture{0, cube, {}});
        draw.add(gl::DrawTriangle{});
        draw.add(gl::EndPass{});
        run(draw);
        EXPECT_NEAR(at(pixels(), 8, 8)[0], 255.0 * static_cast<double>(face + 1) / 8.0, 1.0) << axes[face];
    }
}

TEST_F(DeviceMeshes, DrawItemsArriveFromTheFirstItemOn) {
    // {cell, value}: items 0 and 3 must not be drawn.
    const auto items = fixed_buffer(std::vector<std::array<std::uint32_t, 2>>{{0, 11}, {2, 22}, {5, 33}, {7, 44}});
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program}});
    list.add(gl::BindMeshes{vertices, indices, items});
    list.add(gl::DrawMeshes{.first_index = 3, .index_count = 6, .base_vertex = 1, .first_item = 1, .item_count = 2});
    list.add(gl::EndPass{});
    run(list);
    const auto image = pixels();
    for (std::uint32_t cell = 0; cell < 8; ++cell) {
        const Rgba middle = at(image, cell * 2, 1);
        const int value = cell == 2 ? 22 : cell == 5 ? 33 : 0;
        EXPECT_EQ(middle[0], value) << "cell " << cell;
        EXPECT_NEAR(middle[1], value == 0 ? 0 : 128, 1) << "normal, cell " << cell;
        EXPECT_EQ(middle[2], value == 0 ? 0 : 255) << "uv, cell " << cell;
    }
}

TEST_F(DeviceMeshes, FacesAreCulledByTheirWinding) {
    const auto items = fixed_buffer(std::vector<std::array<std::uint32_t, 2>>{{0, 255}});
    const auto drawn = [&](gl::CullMode cull, bool clockwise) {
        gl::CommandList list;
        list.add(clearing(target));
        list.add(gl::SetPipeline{{.program = program, .cull = cull, .front_is_clockwise = clockwise}});
        list.add(gl::BindMeshes{vertices, indices, items});
        list.add(gl::DrawMeshes{3, 6, 1, 0, 1});
        list.add(gl::EndPass{});
        run(list);
        return at(pixels(), 0, 0)[0] == 255;
    };
    EXPECT_TRUE(drawn(gl::CullMode::none, false));
    EXPECT_TRUE(drawn(gl::CullMode::back, false)) << "the quad is counter-clockwise";
    EXPECT_FALSE(drawn(gl::CullMode::front, false));
    EXPECT_FALSE(drawn(gl::CullMode::back, true));
    EXPECT_TRUE(drawn(gl::CullMode::front, true));
}

TEST_F(DeviceMeshes, DrawsBeyondTheBuffersAreLeftOut) {
    const auto items = fixed_buffer(std::vector<std::array<std::uint32_t, 2>>{{0, 255}});
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program}});
    list.add(gl::BindMeshes{vertices, indices, items});
    list.add(gl::DrawMeshes{3, 60000, 1, 0, 1});
    list.add(gl::DrawMeshes{3, 6, 1, 0, 60000});
    list.add(gl::EndPass{});
    EXPECT_EQ(device().submit(list).failure, gl::Failure::invalid_value);
    EXPECT_THAT(pixels(), Each(Rgba{0, 0, 0, 0}));
}

TEST_F(DeviceDraw, UniformsComeFromTheirOffset) {
    const std::uint32_t step = device().info().uniform_alignment;
    const auto buffer = keep(device().create_buffer({.label = "uniforms", .size = 3 * step}, {}));
    const auto program = full_screen("result = value;", "layout(std140, binding = 1) uniform B { vec4 value; };");
    gl::CommandList list;
    const std::array<float, 4> red = {1, 0, 0, 1}, green = {0, 1, 0, 1};
    list.update(buffer, step, std::span<const float>{red});
    list.update(buffer, 2 * step, std::span<const float>{green});
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program}});
    list.add(gl::BindUniforms{1, buffer, step, 16});
    list.add(gl::DrawTriangle{});
    list.add(gl::SetScissor{{0, 0, 8, 16}});
    list.add(gl::BindUniforms{1, buffer, 2 * step, 16});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    EXPECT_EQ(at(pixels(), 2, 2), (Rgba{0, 255, 0, 255}));
    EXPECT_EQ(at(pixels(), 12, 2), (Rgba{255, 0, 0, 255}));
}

TEST_F(DeviceDraw, LinesArePulledFromStorage) {
    // One horizontal line through the middle of row 5, all columns.
    const float y = (5.5f / 16.0f) * 2.0f - 1.0f;
    const auto points = fixed_buffer(std::vector<std::array<float, 2>>{{-1.0f, y}, {1.0f, y}});
    const auto program = keep(device().create_program(
        {"lines",
         "#version 450 core\nlayout(std430, binding = 3) readonly buffer P { vec2 points[]; };\n"
         "void main() { gl_Position = vec4(points[gl_VertexID], 0.5, 1.0); }\n",
         "#version 450 core\nlayout(location = 0) out vec4 result;\nvoid main() { result = vec4(1.0); }\n"}));
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program}});
    list.add(gl::BindStorage{3, points});
    list.add(gl::DrawLines{2});
    list.add(gl::EndPass{});
    run(list);
    const auto image = pixels();
    for (std::uint32_t row = 0; row < kSize_px; ++row) {
        EXPECT_EQ(at(image, 8, row)[0], row == 5 ? 255 : 0) << "row " << row;
    }
}

TEST_F(DeviceDraw, WhatIsWrittenToSrgbIsEncodedAndWhatIsReadIsLinear) {
    const auto srgb = keep(device().create_texture(
        {.label = "srgb", .format = Format::srgb8_a8, .width = kSize_px, .height = kSize_px}, {}));
    const auto into = keep(device().create_target({.label = "srgb", .colours = {{srgb}}}));
    const auto write = full_screen("result = vec4(0.2140);");
    const auto copy =
        full_screen("result = texelFetch(map, ivec2(1), 0);", "layout(binding = 0) uniform sampler2D map;");
    gl::CommandList list;
    list.add(clearing(into));
    list.add(gl::SetPipeline{{.program = write}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = copy}});
    list.add(gl::BindTexture{0, srgb, {}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    EXPECT_NEAR(read<Rgba>(srgb, kTexels)[0][0], 127.5, 1.5);  // 0.2140 is half way up the sRGB curve
    EXPECT_NEAR(at(pixels(), 1, 1)[0], 0.2140 * 255.0, 1.5);
}

TEST_F(DeviceDraw, BlitsCopyStoredValuesAndScale) {
    const std::array<Rgba, 4> corners = {Rgba{10, 0, 0, 255}, {20, 0, 0, 255}, {30, 0, 0, 255}, {40, 0, 0, 255}};
    const auto srgb = keep(device().create_texture(
        {.label = "srgb", .format = Format::srgb8_a8, .width = 2, .height = 2}, std::as_bytes(std::span{corners})));
    const auto from = keep(device().create_target({.label = "from", .colours = {{srgb}}}));
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetScissor{{0, 0, 1, 1}});
    list.add(gl::EndPass{});
    list.add(gl::Blit{from, target, {0, 0, 2, 2}, {0, 0, 16, 16}});
    run(list);
    const auto image = pixels();
    EXPECT_EQ(at(image, 0, 0)[0], 10);
    EXPECT_EQ(at(image, 15, 0)[0], 20);
    EXPECT_EQ(at(image, 0, 15)[0], 30);
    EXPECT_EQ(at(image, 15, 15)[0], 40);
}

TEST_F(DeviceDraw, GenerateMipsFollowsWhatWasDrawn) {
    const auto texture = keep(
        device().create_texture({.label = "mipped", .format = Format::r32f, .width = 4, .height = 4, .mips = 0}, {}));
    const auto into = keep(device().create_target({.label = "mipped", .colours = {{texture}}}));
    const auto half = full_screen("result = vec4(gl_FragCoord.x < 2.0 ? 1.0 : 0.0);");
    const auto show =
        full_screen("result = vec4(texelFetch(map, ivec2(0), 2).r);", "layout(binding = 0) uniform sampler2D map;");
    const auto mips = keep(device().create_sampler({.label = "mips", .mipmaps = true}));
    gl::CommandList list;
    list.add(gl::BeginPass{.target = into, .viewport = {0, 0, 4, 4}});
    list.add(gl::SetPipeline{{.program = half}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    list.add(gl::GenerateMips{texture});
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = show}});
    list.add(gl::BindTexture{0, texture, mips});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    EXPECT_NEAR(at(pixels(), 0, 0)[0], 128, 1);
}

}  // namespace
}  // namespace gnomon
