#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <array>
#include <functional>
#include <limits>

#include "tests/gl/gl_state_record.h"
#include "tests/gl/manners_fixture.h"
#include "tests/gl/spied_gl.h"

// Errors, messages, queries and debug groups of an engine that shares its context.
namespace gnomon {
namespace {

using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::SizeIs;

struct ErrorRow {
    const char* name;
    GLenum error;
    void (*raise)();
};
void blit_nothing() {
    GLuint empty = 0;
    glCreateFramebuffers(1, &empty);
    glBlitNamedFramebuffer(empty, empty, 0, 0, 1, 1, 0, 0, 1, 1, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glDeleteFramebuffers(1, &empty);
}
void fill_memory() {
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferData(buffer, std::numeric_limits<GLsizeiptr>::max() / 4, nullptr, GL_STATIC_DRAW);
    glDeleteBuffers(1, &buffer);
}
void open_too_many_groups() {
    GLint most = 0;
    glGetIntegerv(GL_MAX_DEBUG_GROUP_STACK_DEPTH, &most);
    for (GLint i = 0; i < most; ++i) glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "group");
    for (GLint i = 1; i < most; ++i) glPopDebugGroup();
}
constexpr ErrorRow kErrors[] = {
    {"invalid_enum", GL_INVALID_ENUM, [] { glEnable(GL_TEXTURE_2D); }},
    {"invalid_value", GL_INVALID_VALUE, [] { glViewport(0, 0, -1, -1); }},
    {"invalid_operation", GL_INVALID_OPERATION, [] { glBindTextureUnit(0, 0xabcdef); }},
    {"stack_overflow", GL_STACK_OVERFLOW, open_too_many_groups},
    {"stack_underflow", GL_STACK_UNDERFLOW, [] { glPopDebugGroup(); }},
    {"out_of_memory", GL_OUT_OF_MEMORY, fill_memory},
    {"invalid_framebuffer", GL_INVALID_FRAMEBUFFER_OPERATION, blit_nothing},
};

class PendingErrors : public Manners, public ::testing::WithParamInterface<ErrorRow> {
protected:
    std::vector<std::pair<const char*, std::function<void()>>> calls() {
        return {
            {"create_texture", [this] { made_texture = device->create_texture({.label = "t"}, {}).handle; }},
            {"create_texture, refused", [this] { EXPECT_FALSE(device->create_texture({.width = 0}, {})); }},
            {"create_sampler", [this] { made_sampler = device->create_sampler({.label = "s"}).handle; }},
            {"create_buffer", [this] { made_buffer = device->create_buffer({.label = "b", .size = 16}, {}).handle; }},
            {"create_program", [this] { EXPECT_FALSE(device->create_program({.label = "bad", .vertex = "bad"})); }},
            {"create_target", [this] { EXPECT_FALSE(device->create_target({.label = "bad"})); }},
            {"import", [this] { EXPECT_FALSE(gl::import_texture(*device, 4711, {})); }},
            {"destroy", [this] { device->destroy(made_texture), device->destroy(made_sampler); }},
            {"submit", [this] { EXPECT_EQ(device->submit(small_list()).failure, gl::Failure::none); }},
            {"submit, erroneous", [this] { EXPECT_NE(device->submit(erroneous).failure, gl::Failure::none); }},
            {"read_texture", [this] { EXPECT_TRUE(device->read_texture(colour, 0, bytes)); }},
            {"read_buffer", [this] { EXPECT_EQ(device->read_buffer(made_buffer, bytes), gl::Readback::failed); }},
            {"take_timings", [this] { EXPECT_THAT(device->take_timings(), IsEmpty()); }},
            {"finish", [this] { device->finish(); }},
            {"end", [this] { device.reset(); }},
            {"make", [this] { make(true); }},
        };
    }
    gl::TextureHandle made_texture;
    gl::SamplerHandle made_sampler;
    gl::BufferHandle made_buffer;
    gl::CommandList erroneous;
    std::array<std::byte, 64> bytes{};
};

TEST_P(PendingErrors, ArePendingAfterEveryCallAndNotHeardOfTwice) {
    erroneous = erroneous_list();
    for (const auto& [name, call] : calls()) {
        SCOPED_TRACE(name);
        GetParam().raise();
        const GlStateRecord before = record_gl_state();
        heard.clear();
        call();
        EXPECT_EQ(differences(before, record_gl_state()), std::vector<std::string>{});
        const std::string_view what = name;
        if (what != "submit, erroneous" && what != "create_program") {
            EXPECT_THAT(heard, IsEmpty()) << "the engine hears of its own error again";
        }
        EXPECT_EQ(glGetError(), GetParam().error);
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR}) << "an error of the device's own";
    }
}

TEST_P(PendingErrors, AreNotMadeUp) {
    erroneous = erroneous_list();
    for (const auto& [name, call] : calls()) {
        call();
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR}) << name;
    }
}

TEST_P(PendingErrors, AreTakenWithoutTheOption) {
    make(false);
    GetParam().raise();
    EXPECT_EQ(device->submit(small_list()).failure, gl::Failure::none);
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

INSTANTIATE_TEST_SUITE_P(Each, PendingErrors, ::testing::ValuesIn(kErrors),
                         [](const auto& row) { return std::string(row.param.name); });

TEST_F(Manners, AnEmptyStackOfGroupsBelowOpenOnesBecomesAnInvalidOperation) {
    glPopDebugGroup();
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "the engine's");
    device->finish();
    EXPECT_EQ(glGetError(), GLenum{GL_INVALID_OPERATION});
    GLint depth = 0;
    glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depth);
    EXPECT_EQ(depth, 2) << "the engine's group stays open";
    glPopDebugGroup();
}

TEST_F(Manners, WhatCannotBeGivenBackIsNoErrorOfTheList) {
    const std::string separable = std::string(kVertex).insert(std::string_view("#version 450 core\n").size(),
                                                              "out gl_PerVertex { vec4 gl_Position; };\n");
    const char* text = separable.c_str();
    const GLuint last = glCreateShaderProgramv(GL_VERTEX_SHADER, 1, &text);
    glUseProgram(last);
    glDeleteProgram(last);  // lives as long as it is in use
    EXPECT_EQ(device->submit(small_list()).failure, gl::Failure::none);
    EXPECT_EQ(glIsProgram(last), GL_FALSE);
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

TEST_F(Manners, TheSinkHearsTheDevicesCallsAndTheEngineItsOwn) {
    Heard sunk;
    make(true, [&](gl::MessageSeverity severity, std::string_view text) {
        if (severity >= gl::MessageSeverity::medium) sunk.emplace_back(text);
    });
    sunk.clear();
    heard.clear();
    device->submit(erroneous_list());
    EXPECT_THAT(sunk, SizeIs(1));
    EXPECT_THAT(heard, IsEmpty());
    glEnable(GL_TEXTURE_2D);
    EXPECT_THAT(sunk, SizeIs(1));
    EXPECT_THAT(heard, SizeIs(1));
    EXPECT_EQ(glGetError(), GLenum{GL_INVALID_ENUM});
}

TEST_F(Manners, GroupsOfTheEngineLeaveRoomForFewOfTheDevice) {
    GLint most = 0, depth = 0;
    glGetIntegerv(GL_MAX_DEBUG_GROUP_STACK_DEPTH, &most);
    for (GLint i = 3; i < most; ++i) glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "the engine's");
    gl::CommandList list;
    for (int i = 0; i < 10; ++i) list.add(gl::BeginGroup{"nested"});
    for (int i = 0; i < 10; ++i) list.add(gl::EndGroup{});
    SpiedGl gl;
    EXPECT_EQ(device->submit(list).failure, gl::Failure::none);
    const auto calls = gl.take();
    EXPECT_EQ(count_calls(calls, "glPushDebugGroup"), 2u);
    EXPECT_EQ(count_calls(calls, "glPopDebugGroup"), 2u);
    glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depth);
    EXPECT_EQ(depth, most - 2);
    for (GLint i = 3; i < most; ++i) glPopDebugGroup();
}

class EngineTimer : public Manners {
protected:
    /// Submits a timed list while a timer of the engine's runs.
    gl::Failure submit_timed() {
        device->set_timing(gl::TimingMode::query);
        gl::CommandList list;
        for (const std::uint32_t id : {3u, 4u}) {
            list.add(gl::BeginTimer{id});
            for (const gl::Command& command : small_list().commands) list.add(command);
            list.add(gl::EndTimer{id});
        }
        glCreateQueries(GL_TIME_ELAPSED, 1, &query);
        glBeginQuery(GL_TIME_ELAPSED, query);
        const gl::Failure failure = device->submit(list).failure;
        glEndQuery(GL_TIME_ELAPSED);
        device->finish();
        GLint available = GL_FALSE;
        glGetQueryObjectiv(query, GL_QUERY_RESULT_AVAILABLE, &available);
        EXPECT_EQ(available, GL_TRUE);
        glDeleteQueries(1, &query);
        return failure;
    }
    GLuint query = 0;
};

TEST_F(EngineTimer, RunsOnWhileTheDeviceMeasures) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(submit_timed(), gl::Failure::none);
        const std::vector<gl::Timing> timings = device->take_timings();
        ASSERT_THAT(timings, SizeIs(2));
        EXPECT_EQ(timings[0].id, 3u);
        EXPECT_EQ(timings[1].id, 4u);
        for (const gl::Timing& timing : timings) {
            EXPECT_GE(timing.gpu_us, 0.0);
            EXPECT_LT(timing.gpu_us, 1e6) << "a span, not a time of day";
        }
    }
    EXPECT_THAT(heard, IsEmpty());
}

TEST_F(EngineTimer, BreaksTheDevicesWithoutTheOption) {
    make(false);
    EXPECT_NE(submit_timed(), gl::Failure::none);
    EXPECT_EQ(glGetError(), GLenum{GL_INVALID_OPERATION}) << "the engine ends its query, which the device has ended";
}

TEST_F(Manners, WhatAListDoesNotBindIsNotTheEngines) {
    const auto reading = device->create_program({.label = "reading", .vertex = kVertex, .fragment = R"(#version 450 core
layout(binding = 7) uniform sampler2D maps[2];
layout(location = 0) out vec4 result;
void main() { result = vec4(texelFetch(maps[0], ivec2(0), 0).rg, texelFetch(maps[1], ivec2(0), 0).rg); }
)"});
    ASSERT_TRUE(reading) << reading.log;
    std::array<GLuint, 2> white{};
    glCreateTextures(GL_TEXTURE_2D, 2, white.data());
    const std::array<GLubyte, 4> texel = {255, 255, 255, 255};
    for (GLuint i = 0; i < 2; ++i) {
        glTextureStorage2D(white[i], 1, GL_RGBA8, 1, 1);
        glTextureSubImage2D(white[i], 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, texel.data());
        glBindTextureUnit(7 + i, white[i]);
    }
    gl::CommandList list;
    list.add(gl::BeginPass{.target = target, .viewport = {0, 0, 4, 4}});
    list.add(gl::SetPipeline{{.program = reading.handle}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    EXPECT_EQ(device->submit(list).failure, gl::Failure::none);
    std::array<std::byte, 64> pixels{};
    EXPECT_TRUE(device->read_texture(colour, 0, pixels));
    EXPECT_THAT(pixels, Each(std::byte{0}));
    for (GLuint i = 0; i < 2; ++i) {
        GLint bound = 0;
        glActiveTexture(GL_TEXTURE7 + i);
        glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
        EXPECT_EQ(static_cast<GLuint>(bound), white[i]);
    }
    glDeleteTextures(2, white.data());
}

}  // namespace
}  // namespace gnomon
