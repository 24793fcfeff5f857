#include <cstdlib>
#include <iostream>
#include <limits>

#include "tests/gl/gl_test_context.h"
#include "tests/soak/soak_world.h"
#include "tests/unit/math/random_seed.h"

// The same long life as on the recording device, on the real one.
namespace gnomon {
namespace {

/// Bytes of ten programs. llvmpipe compiles one once more for each combination of formats and states, some 200 KiB.
/// The rarest combinations come late: in 100 000 frames the last after 40 000.
constexpr std::int64_t kMostGrowth_bytes = 2 << 20;

class GlSoak : public GlTest {
protected:
    /// Switches llvmpipe's threads off. For each list of work in flight, llvmpipe keeps the memory that the list
    /// needed, and the last references to deleted textures. It keeps both until that list is used again. How many lists
    /// there are depends on how its threads are scheduled. That alone moves memory by up to 5 MiB either way, without a
    /// trend (over 44 000 frames). The allocations of this process' own code stay the same to the byte meanwhile.
    /// Without threads there is one such list.
    static void SetUpTestSuite() { setenv("LP_NUM_THREADS", "0", 1); }

    void SetUp() override {
        GlTest::SetUp();
        auto made = FrameSystem::create(device(), library);
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
    }
    void churn(std::size_t frames) {
        for (std::size_t i = 0; i < frames; ++i) {
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
    std::unique_ptr<FrameSystem> frame;
    int failures = 0;
};

/// Programs that are needed for the first time add memory, in fewer stretches the longer the world lives. A leak adds
/// it in each.
TEST_F(GlSoak, ManyFramesLeaveNoObjectsAndNoMemoryBehind) {
    const std::size_t frames = is_exploring() ? 500 : 3000;
    constexpr int kStretches = 4;
    world.use_everything([this] { step(); });
    const std::size_t baseline = objects_when_empty();
    churn(frames);
    EXPECT_EQ(objects_when_empty(), baseline);
    std::int64_t growth = std::numeric_limits<std::int64_t>::max();
    for (int stretch = 0; stretch < kStretches && growth > kMostGrowth_bytes; ++stretch) {
        const std::size_t bytes_before = held_bytes();
        churn(frames);
        EXPECT_EQ(objects_when_empty(), baseline);
        growth = static_cast<std::int64_t>(held_bytes()) - static_cast<std::int64_t>(bytes_before);
        std::cout << frames << " frames after as many on " << device().info().name << ", held memory grew by " << growth
                  << " bytes\n";
    }
    EXPECT_EQ(failures, 0);
    EXPECT_LE(growth, kMostGrowth_bytes);
    RecordProperty("growth_bytes", std::to_string(growth));
}

TEST_F(GlSoak, ASmallLeakWouldBeSeen) {
    world.use_everything([this] { step(); });
    churn(150);
    const std::size_t baseline = objects_when_empty();
    std::vector<gl::BufferHandle> kept;
    constexpr int kFrames = 175;
    const std::size_t bytes_before = held_bytes();
    for (int i = 0; i < kFrames; ++i) {  // 16 KiB a frame: the bound is reached after 128
        const std::vector<std::byte> pages(16384, std::byte{1});
        kept.push_back(device().create_buffer({"kept", pages.size(), gl::BufferUse::fixed}, pages).handle);
        step();
    }
    EXPECT_GT(objects_when_empty(), baseline);
    EXPECT_GT(static_cast<std::int64_t>(held_bytes()), static_cast<std::int64_t>(bytes_before) + kMostGrowth_bytes);
    for (const gl::BufferHandle buffer : kept) device().destroy(buffer);
    EXPECT_EQ(objects_when_empty(), baseline);
}

}  // namespace
}  // namespace gnomon
