#pragma once
#include "systems/frame_system.h"
#include "tests/gl/gl_test_context.h"
#include "tests/stability/hard_cases.h"

namespace gnomon::hard {

/// Worlds of hard cases, drawn.
class HardCaseGl : public GlTest {
protected:
    // Automatic choices cannot have settled before the second frame.
    static constexpr int kSettlingFrames = 2;

    void TearDown() override {
        frame_.reset();
        GlTest::TearDown();
    }
    /// Draws the world with a new frame system; destroys the one before.
    void draw(World& world, int frames = kSettlingFrames) {
        frame_.reset();
        auto made = FrameSystem::create(device(), world.library);
        ASSERT_TRUE(made) << to_line(made.error());
        frame_ = std::move(made).value();
        for (int i = 0; i < frames; ++i) draw_again(world);
    }
    /// Draws the next frame of the world that was drawn last.
    void draw_again(World& world) {
        FrameSettings settings;
        settings.viewport_px = world.viewport_px;
        frame_->run(world.registry, settings);
        EXPECT_STREQ(gl::to_text(frame_->report().failure), "none");
    }
    std::vector<float> visibility(std::uint32_t light) {
        std::vector<float> values;
        EXPECT_TRUE(frame_->read_visibility(light, values));
        return values;
    }
    FrameSystem& frame() { return *frame_; }
    const SceneSnapshot& scene() const { return frame_->snapshot(); }
    const FrameReport& report() const { return frame_->report(); }

private:
    std::unique_ptr<FrameSystem> frame_;
};

}  // namespace gnomon::hard
