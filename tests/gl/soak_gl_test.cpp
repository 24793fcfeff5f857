#include <chrono>

#include "tests/gl/gl_test_context.h"
#include "tests/soak/soak_world.h"
#include "tests/unit/math/random_seed.h"

// The same long life as on the recording device, on the real one, for as many frames as fit a minute.
namespace gnomon {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kWarmUp = std::chrono::seconds(15), kSoak = std::chrono::seconds(45);
constexpr std::size_t kMostGrowth_bytes = 1u << 20;

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
    const std::size_t bytes_before = resident_bytes(), frames_before = frames;

    churn(kSoak);

    EXPECT_EQ(objects_when_empty(), baseline);
    EXPECT_EQ(failures, 0);
    const std::size_t bytes_after = resident_bytes();
    const auto growth = static_cast<std::int64_t>(bytes_after) - static_cast<std::int64_t>(bytes_before);
    std::cout << frames - frames_before << " frames on " << device().info().name << ", resident memory grew by " << growth
              << " bytes\n";
    RecordProperty("frames", std::to_string(frames - frames_before));
    RecordProperty("growth_bytes", std::to_string(growth));
    EXPECT_LE(bytes_after, bytes_before + kMostGrowth_bytes);
}

}  // namespace
}  // namespace gnomon
