#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include "tests/gl/device_fixture.h"

// What lists leave behind, what others leave to them, timing, and messages.
namespace gnomon {
namespace {

using gl::Failure;
using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using DeviceState = DeviceTest;

TEST_F(DeviceState, StateSetByOthersDoesNotReachAList) {
    const auto program = full_screen("result = vec4(1.0);");
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program, .depth_test = gl::DepthTest::greater, .depth_write = true}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    for (const GLenum capability : {GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_BLEND, GL_CULL_FACE, GL_COLOR_LOGIC_OP,
                                    GL_RASTERIZER_DISCARD, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_PRIMITIVE_RESTART}) {
        glEnable(capability);
    }
    glScissor(0, 0, 1, 1);
    glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    glDepthMask(GL_FALSE);
    glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthRange(1.0, 0.0);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glBlendEquation(GL_FUNC_REVERSE_SUBTRACT);
    glFrontFace(GL_CW);
    run(list);
    EXPECT_THAT(pixels(), Each(Rgba{255, 255, 255, 255}));
    EXPECT_THAT(read<float>(depth, kTexels), Each(0.5f));
}

TEST_F(DeviceState, PixelStorageSetByOthersDoesNotReachTransfers) {
    for (const GLenum name : {GL_UNPACK_ROW_LENGTH, GL_PACK_ROW_LENGTH}) glPixelStorei(name, 7);
    for (const GLenum name : {GL_UNPACK_ALIGNMENT, GL_PACK_ALIGNMENT}) glPixelStorei(name, 8);
    const std::vector<std::byte> sent = {std::byte{1}, std::byte{2}, std::byte{3},
                                         std::byte{4}, std::byte{5}, std::byte{6}};
    const auto texture =
        keep(device().create_texture({.label = "3x2", .format = gl::Format::r8, .width = 3, .height = 2}, sent));
    for (const GLenum name : {GL_UNPACK_ROW_LENGTH, GL_PACK_ROW_LENGTH}) glPixelStorei(name, 7);
    EXPECT_EQ(read<std::byte>(texture, 6), sent);
}

TEST_F(DeviceState, NothingOfAListReachesTheNext) {
    const auto white = full_screen("result = vec4(1.0);");
    const auto sampled =
        full_screen("result = vec4(texture(map, vec2(0.5)).r + 0.5);", "layout(binding = 4) uniform sampler2D map;");
    const std::vector<std::byte> bright(4, std::byte{255});
    const auto texture = keep(device().create_texture({.label = "bright"}, bright));
    gl::CommandList first, second;
    first.add(clearing(target));
    first.add(gl::BindTexture{4, texture, {}});
    first.add(gl::SetPipeline{{.program = white, .blend = gl::Blend::add}});
    first.add(gl::SetScissor{{0, 0, 1, 1}});
    first.add(gl::DrawTriangle{});
    first.add(gl::EndPass{});
    second.add(clearing(target));
    second.add(gl::SetPipeline{{.program = sampled}});
    second.add(gl::DrawTriangle{});
    second.add(gl::EndPass{});
    run(first);
    run(second);
    EXPECT_THAT(pixels(), Each(::testing::AnyOf(Rgba{127, 127, 127, 127}, Rgba{128, 128, 128, 128})))
        << "an unbound unit reads 0";
}

TEST_F(DeviceState, AListWithoutAPipelineDrawsNothingThatTheLastOneSet) {
    const auto white = full_screen("result = vec4(1.0);");
    gl::CommandList first, second;
    first.add(clearing(target));
    first.add(gl::SetPipeline{{.program = white}});
    first.add(gl::EndPass{});
    second.add(keeping(target));
    second.add(gl::DrawTriangle{});
    second.add(gl::EndPass{});
    run(first);
    EXPECT_EQ(device().submit(second).failure, Failure::invalid_value);
    EXPECT_THAT(pixels(), Each(Rgba{0, 0, 0, 0}));
}

TEST_F(DeviceState, TheContextIsGivenBackWithoutPrograms) {
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::EndPass{});
    run(list);
    GLint framebuffer = -1, program = -1, vertex_array = -1;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array);
    EXPECT_EQ(framebuffer, 0);
    EXPECT_EQ(program, 0);
    EXPECT_EQ(vertex_array, 0);
}

TEST_F(DeviceState, ErrorsOfOthersAreNotBlamedOnALister) {
    if (kKeepsState) GTEST_SKIP() << "the sink hears nothing of others";
    glEnable(GL_TEXTURE_2D);  // no capability of a core context
    EXPECT_THAT(take_messages(), SizeIs(1));
    EXPECT_EQ(device().submit({}).failure, Failure::none);
    glEnable(GL_TEXTURE_2D);
    take_messages();
    EXPECT_TRUE(keep(device().create_texture({.label = "fine"}, {})));
}

TEST_F(DeviceState, MessagesOfErrorsReachTheSinkDuringTheCall) {
    if (kKeepsState) GTEST_SKIP() << "the sink hears nothing of others";
    EXPECT_THAT(take_messages(), IsEmpty());
    glBindBuffer(GL_TEXTURE_2D, 0);  // no buffer target
    EXPECT_THAT(take_messages(), SizeIs(1));
}

TEST_F(DeviceState, BalancedGroupsNestDeeperThanTheDriverAllows) {
    constexpr int depth_of_groups = 200;
    gl::CommandList list;
    for (int i = 0; i < depth_of_groups; ++i) list.add(gl::BeginGroup{"level " + std::to_string(i)});
    for (int i = 0; i < depth_of_groups; ++i) list.add(gl::EndGroup{});
    run(list);
    run(list);
    GLint open = 0;
    glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &open);
    EXPECT_EQ(open, 1) << "the default group alone is open";
}

TEST_F(DeviceState, ListsThatDoNotCloseAreClosedAndReported) {
    gl::CommandList list;
    list.add(gl::BeginGroup{"open"});
    list.add(gl::BeginTimer{1});
    list.add(clearing(target));
    EXPECT_EQ(device().submit(list).failure, Failure::invalid_value);
    GLint open = 0;
    glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &open);
    EXPECT_EQ(open, 1);
    run({});
}

TEST_F(DeviceState, CommandsOnUnknownObjectsAreLeftOutAndTheRestIsDrawn) {
    const auto plain = keep(device().create_buffer({.label = "plain", .size = 16}, {}));
    const auto texels = keep(device().create_buffer({.label = "texels", .size = 16, .texels = true}, {}));
    const auto program = full_screen("result = vec4(1.0);");
    const std::vector<gl::Command> bad = {gl::BindTexture{0, {999}, {}},
                                          gl::BindTexture{4000, {}, {}},
                                          gl::BindUniforms{0, {999}, 0, 16},
                                          gl::BindStorage{4000, {}},
                                          gl::BindTexels{0, {999}},
                                          gl::BindTexels{0, plain},
                                          gl::BindTexels{4000, texels},
                                          gl::GenerateMips{{999}},
                                          gl::SetScissor{{0, 0, -1, 4}},
                                          gl::BeginPass{.target = {999}},
                                          gl::Blit{{999}, target, {}, {}},
                                          gl::UpdateBuffer{{999}, 0, 0, 4},
                                          gl::ClearBuffer{{999}, 0, 4},
                                          gl::EndGroup{},
                                          gl::EndTimer{3}};
    for (const gl::Command& command : bad) {
        gl::CommandList list;
        list.add(clearing(target));
        list.add(gl::SetPipeline{{.program = program}});
        list.add(command);
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        EXPECT_EQ(device().submit(list).failure, Failure::invalid_value) << gl::to_text(command);
        EXPECT_THAT(pixels(), Each(Rgba{255, 255, 255, 255})) << gl::to_text(command);
    }
}

TEST_F(DeviceState, AnUnknownTargetSwallowsItsPassOnly) {
    const auto program = full_screen("result = vec4(1.0);");
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::EndPass{});
    list.add(clearing({999}, {0.0f, 1.0f, 0.0f, 1.0f}));
    list.add(gl::SetPipeline{{.program = program}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    EXPECT_EQ(device().submit(list).failure, Failure::invalid_value);
    EXPECT_THAT(pixels(), Each(Rgba{0, 0, 0, 0}));
}

TEST_F(DeviceState, AHeadlessContextHasNoWindowToDrawInto) {
    gl::CommandList list;
    list.add(clearing({}));
    list.add(gl::EndPass{});
    list.add(gl::Blit{target, {}, {0, 0, 16, 16}, {0, 0, 16, 16}});
    EXPECT_EQ(device().submit(list).failure, Failure::incomplete_target);
}

gl::CommandList timed(gl::BeginPass pass, gl::ProgramHandle program) {
    gl::CommandList list;
    for (std::uint32_t id = 7; id < 9; ++id) {
        list.add(gl::BeginTimer{id});
        list.add(pass);
        list.add(gl::SetPipeline{{.program = program}});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        list.add(gl::EndTimer{id});
    }
    return list;
}

TEST_F(DeviceState, FinishTimersArePositiveAndThereAtOnce) {
    const auto program = full_screen("result = vec4(1.0);");
    device().set_timing(gl::TimingMode::finish);
    run({});
    run(timed(clearing(target), program));
    const std::vector<gl::Timing> timings = device().take_timings();
    ASSERT_THAT(timings, SizeIs(2));
    EXPECT_EQ(timings[0].id, 7u);
    EXPECT_EQ(timings[1].id, 8u);
    for (const gl::Timing& timing : timings) {
        EXPECT_EQ(timing.submission, 1u);
        EXPECT_GT(timing.gpu_us, 0.0);
    }
    EXPECT_THAT(device().take_timings(), IsEmpty());
}

TEST_F(DeviceState, QueryTimersArriveInOrderAfterAFinish) {
    const auto program = full_screen("result = vec4(1.0);");
    device().set_timing(gl::TimingMode::query);
    run(timed(clearing(target), program));
    device().finish();
    const std::vector<gl::Timing> timings = device().take_timings();
    ASSERT_THAT(timings, SizeIs(2));
    EXPECT_EQ(timings[0].id, 7u);
    EXPECT_EQ(timings[1].id, 8u);
    EXPECT_GE(timings[0].gpu_us, 0.0);
}

TEST_F(DeviceState, TimersThatAreOffReportNothing) {
    const auto program = full_screen("result = vec4(1.0);");
    run(timed(clearing(target), program));
    EXPECT_THAT(device().take_timings(), IsEmpty());
}

TEST_F(DeviceState, SubmissionsAreCountedFromZero) {
    EXPECT_EQ(device().submit({}).submission, 0u);
    EXPECT_EQ(device().submit({}).submission, 1u);
}

TEST_F(DeviceState, TheSameListGivesTheSamePictureBitByBit) {
    const auto program = full_screen("result = vec4(fract(gl_FragCoord.xy * 0.37), 0.3, 1.0);");
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    const auto first = pixels();
    run(list);
    EXPECT_EQ(pixels(), first);
}

}  // namespace
}  // namespace gnomon
