#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

#include "engine/gl/device_gl45.h"
#include "engine/platform/context.h"
#include "tests/soak/soak_world.h"
#include "tests/system/fault_scenes.h"
#include "tests/unit/math/random_seed.h"

// Nothing lives in the device's memory alone: after the context is gone, a new one shows the same pictures from the
// same world.
namespace gnomon {
namespace {

using Picture = std::vector<std::uint8_t>;
constexpr int kFrames = 12, kLostBefore = 7;

/// Everything that dies with a context.
struct Gpu {
    std::unique_ptr<platform::Context> context;
    std::unique_ptr<gl::Device> device;
    std::unique_ptr<FrameSystem> frame;

    static std::optional<Gpu> make(const assets::MeshLibrary& library, const shadow::History& fit_history = {}) {
        Gpu gpu;
        auto context = platform::make_headless_context(false);
        if (!context) return std::nullopt;
        gpu.context = std::move(context).value();
        auto device = gl::make_gl45_device({});
        if (!device) return std::nullopt;
        gpu.device = std::move(device).value();
        auto frame = FrameSystem::create(*gpu.device, library, fit_history);
        if (!frame) return std::nullopt;
        gpu.frame = std::move(frame).value();
        return gpu;
    }
    /// Destroys the context first, before the objects that live in it.
    void lose() {
        context.reset();
        frame.reset();
        device.reset();
    }
};

/// Draws `kFrames` pictures of a world in motion; the context is destroyed before frame `lost_before`.
std::vector<Picture> film(const FaultScene& scene, int lost_before) {
    std::optional<Gpu> gpu = Gpu::make(*scene.library);
    std::vector<Picture> pictures;
    for (int i = 0; i < kFrames; ++i) {
        if (i == lost_before) {
            const shadow::History fit_history = gpu ? gpu->frame->fit_history() : shadow::History{};
            if (gpu) gpu->lose();
            gpu = Gpu::make(*scene.library, fit_history);
        }
        if (!gpu) {
            ADD_FAILURE() << "no context";
            return pictures;
        }
        scene.play(i);
        gpu->frame->run(*scene.registry, {.viewport_px = {64, 64}, .exposure_ev = {}});
        EXPECT_STREQ(gl::to_text(gpu->frame->report().failure), "none") << "frame " << i;
        EXPECT_TRUE(gpu->frame->read_picture(pictures.emplace_back())) << "frame " << i;
    }
    return pictures;
}

/// Makes a world that changes at random, the same way for the same seed. Plays once.
FaultScene random_scene(std::uint64_t seed) {
    const auto world = std::make_shared<SoakWorld>(seed);
    constexpr int kSettling = 100;  // until there are lights and casters
    constexpr int kChurns = 6;      // a frame: most show
    for (int i = 0; i < kSettling; ++i) world->churn();
    const auto play = [world](int) {
        for (int k = 0; k < kChurns; ++k) world->churn();
    };
    return {std::make_shared<assets::MeshLibrary>(test_library()), {world, &world->registry()}, play};
}

/// Returns whether pictures of the old context and of the new one change: without that equal ones prove nothing.
bool changes_before_and_after(const std::vector<Picture>& pictures) {
    const auto changes = [&](int from, int to) {
        const auto begin = pictures.begin() + from, end = pictures.begin() + to;
        return std::adjacent_find(begin - 1, end, std::not_equal_to<>()) != end;
    };
    return changes(1, kLostBefore) && changes(kLostBefore, kFrames);
}

/// Returns whether the scene changes enough to judge.
bool expect_unbroken(const std::function<FaultScene()>& scene) {
    const std::vector<Picture> unbroken = film(scene(), kFrames);
    EXPECT_EQ(unbroken.size(), static_cast<std::size_t>(kFrames));
    if (unbroken.size() != static_cast<std::size_t>(kFrames) || !changes_before_and_after(unbroken)) return false;
    EXPECT_EQ(film(scene(), kLostBefore), unbroken);
    return true;
}

TEST(ContextLoss, ANewContextShowsTheSamePicturesOfTheBuiltInScene) { EXPECT_TRUE(expect_unbroken(courtyard_scene)); }

TEST(ContextLoss, ANewContextShowsTheSamePicturesOfARandomWorld) {
    constexpr std::uint64_t kMostWorlds = 8;  // in a few, all that changes is out of sight
    const std::uint64_t seed = print_seed();
    bool judged = false;
    for (std::uint64_t world = 0; world < kMostWorlds && !judged && !testing::Test::HasFailure(); ++world)
        judged = expect_unbroken([&] { return random_scene(seed + world); });
    EXPECT_TRUE(judged);
}

}  // namespace
}  // namespace gnomon
