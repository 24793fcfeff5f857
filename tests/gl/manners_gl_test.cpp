#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <regex>
#include <set>

#include "engine/gl/device_gl45.h"
#include "engine/platform/context.h"
#include "tests/gl/gl_state_record.h"
#include "tests/gl/spied_gl.h"
#include "tests/source_paths.h"

// Errors, messages, queries and debug groups of an engine that shares its context; and what keeping state costs.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

using Heard = std::vector<std::string>;
void GLAPIENTRY hear(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text, const void* to) {
    if (type == GL_DEBUG_TYPE_ERROR) const_cast<Heard*>(static_cast<const Heard*>(to))->emplace_back(text);
}

/// A context of an engine whose callback hears errors, and a device that shares it.
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
    /// One pass with one draw.
    gl::CommandList small_list() const {
        gl::CommandList list;
        list.add(gl::BeginPass{.target = target, .viewport = {0, 0, 4, 4}, .clear_colour = true});
        list.add(gl::SetPipeline{{.program = program}});
        list.add(gl::BindUniforms{1, uniforms, 0, 256});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        return list;
    }
    /// A list that raises an error of OpenGL's own: copies between sample counts do not exist.
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
    glNamedBufferData(buffer, GLsizeiptr{1} << 61, nullptr, GL_STATIC_DRAW);
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
    /// A timed list while a timer of the engine's runs.
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

TEST(SpiedGlSelfTest, KnowsEveryFunctionThatTheExecutorCalls) {
    const std::regex call("(?:epoxy_|\\b)(gl[A-Z]\\w+)(?=\\(|[,>])");
    std::set<std::string> called;
    for (const auto& file : std::filesystem::directory_iterator(test::source_folder() / "engine/gl")) {
        std::ifstream in(file.path());
        const std::string text((std::istreambuf_iterator<char>(in)), {});
        for (std::sregex_iterator at(text.begin(), text.end(), call), end; at != end; ++at) called.insert((*at)[1]);
    }
    EXPECT_GT(called.size(), 100u);
    const std::vector<std::string> spied = SpiedGl::names();
    EXPECT_EQ(called, std::set<std::string>(spied.begin(), spied.end()));
}

/// What a list costs in calls of OpenGL.
class CostOfManners : public Manners {
protected:
    std::vector<std::string> calls_of(const gl::CommandList& list) {
        SpiedGl gl;
        EXPECT_EQ(device->submit(list).failure, gl::Failure::none);
        return gl.take();
    }
    static std::size_t queries(const std::vector<std::string>& calls) {
        return count_calls(calls, "glGet") + count_calls(calls, "glIs");
    }
    /// The small list with textures at a number of units.
    gl::CommandList binding(std::uint32_t units) {
        gl::CommandList list;
        for (std::uint32_t unit = 0; unit < units; ++unit) list.add(gl::BindTexture{unit, colour, {}});
        for (const gl::Command& command : small_list().commands) list.add(command);
        return list;
    }
};

TEST_F(CostOfManners, AListThatDrawsNothingChangesNothing) {
    EXPECT_THAT(calls_of({}), Each(::testing::AnyOf(StartsWith("glGetError"), StartsWith("glGetGraphicsReset"),
                                                    StartsWith("glIsEnabled"), StartsWith("glGetPointerv"))));
    gl::CommandList upload;
    upload.update<std::uint32_t>(uniforms, 0, std::vector<std::uint32_t>(4));
    calls_of(upload);  // the loader looks functions up at their first call
    const auto calls = calls_of(upload);
    EXPECT_EQ(calls.size(), calls_of({}).size() + 1);
    EXPECT_THAT(calls, Contains(StartsWith("glNamedBufferSubData")));
}

TEST_F(CostOfManners, ATextureCostsTwoQueriesItsBindingAndItsReturn) {
    const auto one = calls_of(binding(1)), five = calls_of(binding(5));
    EXPECT_EQ(queries(five), queries(one) + 4 * 2);
    EXPECT_EQ(count_calls(five, "glBindTexture("), 5u * 2);
    EXPECT_EQ(count_calls(five, "glActiveTexture"), 4u + 5 + 1) << "to bind, to give back, and the engine's";
    EXPECT_EQ(count_calls(five, "glBindSampler"), 0u) << "no sampler was bound, and none is";
}

TEST_F(CostOfManners, StateThatIsAsNeededIsNotSet) {
    const auto first = calls_of(small_list());
    std::cout << "small list: " << first.size() << " calls, " << queries(first) << " of them queries\n";
    // The engine's state is the default: only what a list cannot do without differs.
    EXPECT_EQ(count_calls(first, "glEnable") + count_calls(first, "glDisable"), 2u * 4)
        << "dithering, seamless cubes, point size, encoding";
    EXPECT_EQ(count_calls(first, "glClipControl"), 2u);
    for (const char* same : {"glPolygonMode", "glColorMask", "glBlend", "glDepthRange", "glCullFace", "glFrontFace",
                             "glBindTexture", "glLineWidth", "glProvokingVertex"})
        EXPECT_EQ(count_calls(first, same), 0u) << same;
    const auto again = calls_of(small_list());
    EXPECT_EQ(again, first) << "a list costs the same every time";
    glDisable(GL_DITHER);
    EXPECT_EQ(calls_of(small_list()).size(), first.size() - 2) << "what the engine has off is not switched";
}

TEST_F(CostOfManners, WithoutTheOptionTheCallsAreThese) {
    make(false);
    calls_of(small_list());
    const std::vector<std::string> reset = {"glDisable x21",   "glEnable x2",    "glClipControl",
                                            "glDepthRange",    "glPolygonMode",  "glColorMask",
                                            "glBlendEquation", "glUseProgram",   "glBindVertexArray",
                                            "glBindTextures",  "glBindSamplers", "glBindBuffersBase x2"};
    std::vector<std::string> wanted = {"glGetGraphicsResetStatus", "glGetError"};
    wanted.insert(wanted.end(), reset.begin(), reset.end());
    for (const char* name :
         {"glBindFramebuffer", "glEnable", "glViewport", "glDisable", "glClearBufferfv", "glUseProgram", "glDisable",
          "glCullFace", "glFrontFace", "glDisable", "glDepthFunc", "glDepthMask", "glDisable x2", "glBlendEquation",
          "glBindBufferRange", "glBindVertexArray", "glDrawArrays"})
        wanted.emplace_back(name);
    wanted.insert(wanted.end(), reset.begin(), reset.end());
    for (const char* name : {"glVertexArrayVertexBuffer x2", "glVertexArrayElementBuffer", "glBindFramebuffer",
                             "glGetError", "glGetGraphicsResetStatus"})
        wanted.emplace_back(name);
    EXPECT_EQ(names_of(calls_of(small_list())), wanted);
}

}  // namespace
}  // namespace gnomon
