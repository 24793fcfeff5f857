#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>

#include "engine/gl/device_recording.h"
#include "tests/long_run.h"
#include "tests/soak/soak_world.h"
#include "tests/unit/math/random_seed.h"

// A long life on the recording device: nothing is misused, nothing is left behind, and memory stays.
namespace gnomon {
namespace {

constexpr int kLongRunFrames = kSanitized ? 5000 : 100000;
constexpr int kShortRunFrames = 10000;
constexpr int kForgetEvery = 64;
constexpr std::size_t kMostGrowth_bytes = 1u << 20;

class Soak : public ::testing::Test {
protected:
    void SetUp() override {
        auto made = FrameSystem::create(device, library);
        ASSERT_TRUE(made) << to_line(made.error());
        frame = std::move(made).value();
    }
    void step() {
        frame->run(world.registry(), {.viewport_px = {64, 64}, .exposure_ev = {}});
        if (frame->commands().commands.empty()) ++empty_frames;
        for (const LightReport& light : frame->report().lights) drawn_views += light.counts.views_drawn;
        if (++steps % kForgetEvery == 0) forget();
    }
    void forget() {
        for (const gl::Finding& f : device.findings()) ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
        created += static_cast<std::size_t>(
            std::count_if(device.resource_calls().begin(), device.resource_calls().end(),
                          [](const gl::ResourceCall& c) { return c.kind == gl::ResourceCall::Kind::create_texture; }));
        device.forget();
    }
    void churn(int frames) {
        for (int i = 0; i < frames && !HasFailure(); ++i) {
            world.churn();
            step();
        }
    }
    std::vector<std::string> labels_when_empty() {
        world.clear([this] { step(); });
        return device.live_labels();
    }

    gl::RecordingDevice device;
    const assets::MeshLibrary library = test_library();
    SoakWorld world{print_seed()};
    std::unique_ptr<FrameSystem> frame;
    std::size_t created = 0, steps = 0, empty_frames = 0;
    std::uint64_t drawn_views = 0;
};

TEST_F(Soak, ThousandsOfFramesLeaveNoObjectsAndNoMemoryBehind) {
    const int frames = is_long_run() ? kLongRunFrames : std::min(kShortRunFrames, kLongRunFrames);
    world.use_everything([this] { step(); });
    const std::vector<std::string> baseline = labels_when_empty();
    churn(frames / 10);
    labels_when_empty();
    forget();
    const std::size_t bytes_before = held_bytes(), created_before = created;
    drawn_views = 0;

    churn(frames);

    std::vector<std::string> left = labels_when_empty(), more, less;
    std::set_difference(left.begin(), left.end(), baseline.begin(), baseline.end(), std::back_inserter(more));
    std::set_difference(baseline.begin(), baseline.end(), left.begin(), left.end(), std::back_inserter(less));
    EXPECT_THAT(more, ::testing::IsEmpty());
    EXPECT_THAT(less, ::testing::IsEmpty());
    forget();
    const std::size_t bytes_after = held_bytes();
    if (!kSanitized) {
        EXPECT_LE(bytes_after, bytes_before + kMostGrowth_bytes);
    }
    // The soak did soak.
    EXPECT_EQ(empty_frames, 0u);
    EXPECT_GT(created - created_before, static_cast<std::size_t>(frames / 100));
    EXPECT_GT(drawn_views, static_cast<std::uint64_t>(frames / 2));
    const auto growth = static_cast<std::int64_t>(bytes_after) - static_cast<std::int64_t>(bytes_before);
    RecordProperty("growth_bytes", std::to_string(growth));
    std::cout << frames << " frames: " << created - created_before << " maps made, " << drawn_views
              << " views drawn, held memory grew by " << growth << " bytes\n";
}

TEST_F(Soak, AnObjectLeftBehindWouldBeSeen) {
    world.use_everything([this] { step(); });
    const std::vector<std::string> baseline = labels_when_empty();
    const auto stray = device.create_buffer({"stray", 16, gl::BufferUse::updated}, {});
    EXPECT_NE(labels_when_empty(), baseline);
    device.destroy(stray.handle);
    EXPECT_EQ(labels_when_empty(), baseline);
}

TEST_F(Soak, MemoryKeptWouldBeSeen) {
    const std::size_t before = held_bytes();
    std::vector<char> kept(4 * kMostGrowth_bytes, 'x');
    EXPECT_GT(held_bytes(), before + kMostGrowth_bytes) << kept.back();
}

}  // namespace
}  // namespace gnomon
