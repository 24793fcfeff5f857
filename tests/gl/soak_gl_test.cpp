#include <algorithm>
#include <chrono>
#include <iostream>

#include "tests/gl/gl_test_context.h"
#include "tests/soak/soak_world.h"
#include "tests/unit/math/random_seed.h"

// The same long life as on the recording device, on the real one, for as many frames as fit a minute.
namespace gnomon {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kWarmUp = std::chrono::seconds(10), kSlice = std::chrono::seconds(4);
constexpr std::size_t kSlices = 12;
/// llvmpipe's own memory goes up and down by 3 MiB either way over any 1000 frames (measured over 30 000 frames,
/// without a trend); medians of six even that out. What Gnomon itself keeps is bounded to 1 MiB by the soak on the
/// recording device.
constexpr std::int64_t kMostGrowth_bytes = 4 << 20;

std::int64_t median(std::vector<std::size_t> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return static_cast<std::int64_t>(*middle);
}

class GlSoak : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        auto made = Frame::create(device(), library);
        ASSERT_TRUE(made) << to_line(made.error());
        frame = std::move(made).value();
    }
    void TearDown() override {
        frame.reset();
        GlTest::TearDown();
    }
    void step() {
        frame->run(world.registry(), {.viewport_px = {64, 64}, .exposure_ev = {}});
        failures += frame->report().failure != gl::Failure::none;
        ++frames;
    }
    void churn(Clock::duration time) {
        for (const auto end = Clock::now() + time; Clock::now() < end;) {
            world.churn();
            step();
        }
    }
    std::size_t objects_when_empty() {
        world.clear([this] { step(); });
        std::vector<std::uint8_t> picture;
        EXPECT_TRUE(frame->read_picture(picture));  // waits for the device
        return gl::live_objects(device());
    }

    const assets::MeshLibrary library = test_library();
    SoakWorld world{print_seed()};
    std::unique_ptr<Frame> frame;
    std::size_t frames = 0;
    int failures = 0;
};

TEST_F(GlSoak, AMinuteOfFramesLeavesNoObjectsAndNoMemoryBehind) {
    world.use_everything([this] { step(); });
    const std::size_t baseline = objects_when_empty();
    churn(kWarmUp);
    EXPECT_EQ(objects_when_empty(), baseline);
    const std::size_t frames_before = frames;
    std::vector<std::size_t> first, second;  // resident bytes after each slice
    for (std::size_t i = 0; i < kSlices; ++i) {
        churn(kSlice);
        EXPECT_EQ(objects_when_empty(), baseline);
        (i < kSlices / 2 ? first : second).push_back(resident_bytes());
    }
    EXPECT_EQ(failures, 0);
    const std::int64_t growth = median(second) - median(first);
    std::cout << frames - frames_before << " frames on " << device().info().name << ", resident memory grew by "
              << growth << " bytes\n";
    RecordProperty("frames", std::to_string(frames - frames_before));
    RecordProperty("growth_bytes", std::to_string(growth));
    EXPECT_LE(growth, kMostGrowth_bytes);
}

}  // namespace
}  // namespace gnomon
