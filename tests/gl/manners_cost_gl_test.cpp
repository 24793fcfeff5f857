#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <regex>
#include <set>

#include "tests/gl/manners_fixture.h"
#include "tests/gl/spied_gl.h"
#include "tests/gl/unusual_gl_state.h"
#include "tests/source_paths.h"
#include "tests/unit/allocation_counter.h"

// Cost of keeping the state of a shared context, in calls of OpenGL. Without that option the calls are exactly as
// listed.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::StartsWith;

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

/// Calls of OpenGL that a list costs.
class CostOfManners : public Manners {
protected:
    std::vector<std::string> calls_of(const gl::CommandList& list) {
        SpiedGl gl;
        for (int i = 0; i < 2; ++i) {
            gl.take();  // the loader looks functions up at their first call
            EXPECT_EQ(device->submit(list).failure, gl::Failure::none);
        }
        return gl.take();
    }
    static std::size_t queries(const std::vector<std::string>& calls) {
        return count_calls(calls, "glGet") + count_calls(calls, "glIs");
    }
    /// Returns the small list with textures at a number of units.
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
    for (int i = 0; i < 4; ++i) calls_of(upload);  // places for bytes are made, and used once
    const auto calls = calls_of(upload);
    EXPECT_EQ(calls.size(), calls_of({}).size() + 5) << "a flush, a copy, and a fence that is made, passed and deleted";
    EXPECT_THAT(calls, Contains(StartsWith("glCopyNamedBufferSubData")));
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
    EXPECT_LE(first.size(), 100u) << "docs/how-to/own_context.md states 96";
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

TEST_F(CostOfManners, NothingIsAllocatedOnceWarm) {
    const UnusualGlState engine(EngineWork::pipeline);
    const gl::CommandList list = binding(5);
    std::size_t first = 0, warm = 0;
    for (int i = 0; i < 20; ++i) {
        const std::size_t before = allocation_count();
        EXPECT_EQ(device->submit(list).failure, gl::Failure::none);
        (i < 3 ? first : warm) += allocation_count() - before;
    }
    EXPECT_GT(first, 0u) << "the engine's subroutines are kept somewhere";
    EXPECT_EQ(warm, 0u);
}

TEST_F(CostOfManners, WithoutTheOptionTheCallsAreThese) {
    make(false);
    std::cout << "small list without the option: " << calls_of(small_list()).size() << " calls\n";
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
