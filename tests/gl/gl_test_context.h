#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/gl/device_gl45.h"
#include "engine/platform/context.h"
#include "gnomon/light.h"

namespace gnomon {

/// Switches the option of all devices in these tests; gl_device_kept sets it.
#ifdef GNOMON_KEPT_STATE
inline constexpr bool kKeepsState = true;
#else
inline constexpr bool kKeepsState = false;
#endif

/// Names a kind of light in tests' names and traces.
inline const char* kind_name(LightKind kind) {
    return kind == LightKind::directional ? "sun" : kind == LightKind::spot ? "spot" : "point";
}

/// A headless debug context with the OpenGL device, new for each test. TearDown fails on any driver message of
/// medium or higher severity that was not taken, and on objects left alive.
class GlTest : public ::testing::Test {
protected:
    void SetUp() override {
        auto made_context = platform::make_headless_context(true);
        ASSERT_TRUE(made_context) << to_line(made_context.error());
        context_ = std::move(made_context).value();
        const auto sink = [this](gl::MessageSeverity severity, std::string_view text) {
            if (severity >= gl::MessageSeverity::medium) messages_.emplace_back(text);
        };
        auto made_device = gl::make_gl45_device(sink, {.keeps_state = kKeepsState});
        ASSERT_TRUE(made_device) << to_line(made_device.error());
        device_ = std::move(made_device).value();
    }

    void TearDown() override {
        if (device_) {
            while (!cleanups_.empty()) {
                cleanups_.back()();
                cleanups_.pop_back();
            }
            EXPECT_EQ(gl::live_objects(*device_), 0u) << "objects were left alive";
            device_.reset();
        }
        for (const std::string& message : messages_) ADD_FAILURE() << "OpenGL says: " << message;
        context_.reset();
    }

    gl::Device& device() { return *device_; }

    /// Messages of medium or higher severity so far; they no longer fail the test.
    std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

    /// Returns the handle, which must have been made. It is destroyed at the end of the test, last made first.
    template <class H>
    H keep(const gl::Created<H>& created) {
        EXPECT_TRUE(created) << gl::to_text(created.failure) << ": " << created.log;
        if (created) cleanups_.emplace_back([this, handle = created.handle] { device_->destroy(handle); });
        return created.handle;
    }

    /// Submits a list, which must succeed.
    void run(const gl::CommandList& list) {
        EXPECT_STREQ(gl::to_text(device_->submit(list).failure), "none") << gl::to_text(list);
    }

    /// Reads all texels of one layer, T as the format travels (see Device::read_texture).
    template <class T>
    std::vector<T> read(gl::TextureHandle texture, std::size_t values, std::uint32_t layer = 0) {
        std::vector<T> texels(values);
        EXPECT_TRUE(device_->read_texture(texture, layer, std::as_writable_bytes(std::span{texels})));
        return texels;
    }

private:
    std::unique_ptr<platform::Context> context_;
    std::unique_ptr<gl::Device> device_;
    std::vector<std::string> messages_;
    std::vector<std::function<void()>> cleanups_;
};

}  // namespace gnomon
