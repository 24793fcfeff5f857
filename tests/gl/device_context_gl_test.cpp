#include <epoxy/gl.h>
#include <gmock/gmock.h>
#include <gtest/gtest-spi.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/gl/gl_test_context.h"

// Contexts, and that the fixture of all OpenGL tests notices what it promises to notice.
namespace gnomon {
namespace {

TEST(HeadlessContext, IsOpenGl45CoreAndReportsResets) {
    auto context = platform::make_headless_context(false);
    ASSERT_TRUE(context) << to_line(context.error());
    GLint major = 0, minor = 0, profile = 0, strategy = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
    EXPECT_GE(major * 10 + minor, 45);
    EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_EQ(strategy, GL_LOSE_CONTEXT_ON_RESET);
}

TEST(HeadlessContext, DebugIsOnlyOnWhenAskedFor) {
    for (const bool debug : {false, true}) {
        auto context = platform::make_headless_context(debug);
        ASSERT_TRUE(context);
        GLint flags = 0;
        glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
        EXPECT_EQ((flags & GL_CONTEXT_FLAG_DEBUG_BIT) != 0, debug);
    }
}

TEST(HeadlessContext, EndingOneLeavesAnotherCurrent) {
    auto first = platform::make_headless_context(false);
    auto second = platform::make_headless_context(false);
    ASSERT_TRUE(first);
    ASSERT_TRUE(second);
    std::move(first).value().reset();
    auto device = gl::make_gl45_device({});
    ASSERT_TRUE(device);
    EXPECT_TRUE(device.value()->create_buffer({.label = "alive", .size = 4}, {}));
}

TEST(HeadlessContext, AdviceOnSpeedIsNoComplaint) {
    auto context = platform::make_headless_context(true);
    ASSERT_TRUE(context);
    std::vector<std::pair<gl::MessageSeverity, std::string>> heard;
    auto device = gl::make_gl45_device(
        [&](gl::MessageSeverity severity, std::string_view text) { heard.emplace_back(severity, std::string(text)); });
    ASSERT_TRUE(device);
    heard.clear();
    const auto say = [](GLenum type, const char* text) {
        glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, type, 1, GL_DEBUG_SEVERITY_MEDIUM, -1, text);
    };
    say(GL_DEBUG_TYPE_PERFORMANCE, "a shader is compiled again");
    say(GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR, "anything may happen");
    using Heard = std::pair<gl::MessageSeverity, std::string>;
    EXPECT_THAT(heard, ::testing::ElementsAre(Heard(gl::MessageSeverity::low, "a shader is compiled again"),
                                              Heard(gl::MessageSeverity::medium, "anything may happen")));
}

class GlTestSelfTest : public GlTest {
protected:
    void TearDown() override {
        if (leak_) {
            EXPECT_NONFATAL_FAILURE(GlTest::TearDown(), "objects were left alive");
        } else if (message_) {
            EXPECT_NONFATAL_FAILURE(GlTest::TearDown(), "OpenGL says");
        } else {
            GlTest::TearDown();
        }
    }
    bool leak_ = false, message_ = false;
};

TEST_F(GlTestSelfTest, ALeakFailsTheTest) {
    EXPECT_TRUE(device().create_buffer({.label = "leaked", .size = 4}, {}));
    leak_ = true;
}

TEST_F(GlTestSelfTest, AnErrorMessageFailsTheTest) {
    glBindBuffer(GL_TEXTURE_2D, 0);  // no buffer target
    message_ = true;
}

TEST_F(GlTestSelfTest, CleanUseFailsNothing) { keep(device().create_buffer({.label = "kept", .size = 4}, {})); }

}  // namespace
}  // namespace gnomon
