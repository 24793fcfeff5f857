#include "systems/shadow/budget/automatic_limit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "bench/scaling/many_lights_scene.h"
#include "engine/math/frustum.h"
#include "gnomon/components.h"
#include "gnomon/light.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/frame_system.h"
#include "tests/system/timed_device.h"

/// The level of ./gnomon bench demand, seen from above at 1920 x 1080: its lights want more than the automatic limit.
namespace gnomon {
namespace {

constexpr std::uint64_t kLevelSeed = 7;
constexpr std::uint32_t kLights = 200, kFewLights = 8;
constexpr int kRest = 60;
constexpr double kHigh_m = 90.0, kFar_m = 40.0;

struct WideLevel {
    explicit WideLevel(std::uint32_t lights) {
        spawned = game::spawn_scene(bench::demand_scene(lights, kLevelSeed), world, library);
        frame = std::move(FrameSystem::create(device, library)).value();
        camera = spawned.cameras.front().entity;
    }
    void look(double high_m) {
        world.patch<Transform>(camera, [high_m](Transform& t) {
            t.translation_m = {0.0, high_m, kFar_m};
            t.rotation = glm::quat_cast(math::basis_from_back(glm::dvec3(0.0, high_m, kFar_m)));
        });
    }
    void look_up() {
        world.patch<Transform>(camera, [](Transform& t) {
            t.rotation = glm::quat_cast(math::basis_from_back({0.0, -1.0, 0.01}));
        });
    }
    const FrameReport& step() {
        frame->run(world, settings);
        return frame->report();
    }
    /// Changes the settings of every shadow.
    template <class Change>
    void for_shadows(const Change& change) {
        for (const auto& light : spawned.lights)
            if (world.get<LightShadow>(light.entity)) world.patch<LightShadow>(light.entity, change);
    }
    std::size_t limited() const {
        std::size_t count = 0;
        for (const LightReport& light : frame->report().lights) count += light.reason == Reason::budget_shrunk ? 1 : 0;
        return count;
    }
    bool has_budgets() const {
        for (const LightReport& light : frame->report().lights)
            if (light.budget) return true;
        return false;
    }

    TimedDevice device;
    assets::MeshLibrary library;
    ecs::Registry world;
    game::SpawnedScene spawned;
    ecs::Entity camera;
    std::unique_ptr<FrameSystem> frame;
    FrameSettings settings{.viewport_px = {1920, 1080}, .exposure_ev = 5.0f};
};

class AutomaticLimit : public ::testing::Test {
protected:
    WideLevel& start(std::uint32_t lights = kLights, double high_m = kHigh_m) {
        level = std::make_unique<WideLevel>(lights);
        level->look(high_m);
        return *level;
    }
    void TearDown() override {
        level->frame.reset();
        level->device.recording.check_leaks();
        for (const gl::Finding& f : level->device.recording.findings())
            ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
    }
    std::unique_ptr<WideLevel> level;
};

TEST_F(AutomaticLimit, HoldsFromTheFirstFrameOn) {
    start();
    for (int i = 0; i < kRest; ++i) {
        level->step();
        ASSERT_LE(level->device.map_bytes(), shadow::kAutomatic_bytes) << i;
    }
    EXPECT_LE(level->device.most_map_bytes, shadow::kAutomatic_bytes) << "not even between two calls";
    EXPECT_GT(level->device.map_bytes(), shadow::kAutomatic_bytes / 2) << "what there is, is used";
    EXPECT_GT(level->limited(), 0u);
    const auto shadowless = [](const LightReport& light) { return light.reason == Reason::over_budget; };
    const auto& lights = level->frame->report().lights;
    EXPECT_TRUE(std::none_of(lights.begin(), lights.end(), shadowless));
    for (int i = 0; i < 2 * kRest && !level->step().still; ++i) {
    }
    EXPECT_TRUE(level->step().still) << "it comes to rest";
}

TEST_F(AutomaticLimit, IsWhatHoldsThem) {
    start();
    level->settings.shadow_budget.bytes = shadow::ShadowBudget::kUnlimited;
    for (int i = 0; i < kRest; ++i) level->step();
    EXPECT_GT(level->device.map_bytes(), shadow::kAutomatic_bytes) << "without it they take more";
    EXPECT_EQ(level->limited(), 0u);
    EXPECT_FALSE(level->has_budgets());
}

TEST_F(AutomaticLimit, LeavesRoomToKeptVisibility) {
    start();
    // As many frames as it takes until nothing moves and visibility is kept.
    for (int i = 0; i < 3 * kRest; ++i) level->step();
    std::uint64_t kept_bytes = 0;
    std::size_t kept = 0, mapped = 0;
    for (const LightReport& light : level->step().lights) {
        kept_bytes += light.kept.bytes;
        kept += light.kept.reason == Reason::visibility_kept ? 1 : 0;
        mapped += light.counts.bytes > 0 ? 1 : 0;
    }
    EXPECT_GT(level->limited(), 0u) << "the limit binds";
    EXPECT_GT(kept, mapped * 3 / 4);
    EXPECT_LE(level->device.map_bytes() + kept_bytes, shadow::kAutomatic_bytes);
    EXPECT_GT(level->device.map_bytes(), shadow::kAutomatic_bytes / 2);
}

TEST_F(AutomaticLimit, GrowsWithThePicture) {
    start();
    level->settings.viewport_px = {3840, 2160};
    for (int i = 0; i < kRest; ++i) level->step();
    EXPECT_GT(level->device.map_bytes(), shadow::kAutomatic_bytes);
    EXPECT_LE(level->device.map_bytes(), 4 * shadow::kAutomatic_bytes);
}

TEST_F(AutomaticLimit, ChangesNothingWhereLightsWantLess) {
    start(kFewLights);
    WideLevel other(kFewLights);
    other.look(kHigh_m);
    other.settings.shadow_budget.bytes = shadow::ShadowBudget::kUnlimited;
    for (int i = 0; i < kRest; ++i) {
        level->step();
        other.step();
        ASSERT_EQ(level->frame->commands(), other.frame->commands()) << i;
        ASSERT_EQ(level->device.map_bytes(), other.device.map_bytes()) << i;
    }
    EXPECT_GT(level->device.map_bytes(), 0u);
    EXPECT_LT(level->device.map_bytes(), shadow::kAutomatic_bytes);
    EXPECT_FALSE(level->has_budgets()) << "no budget runs";
}

TEST_F(AutomaticLimit, EndsWhereLightsWantLessAgain) {
    start();
    for (int i = 0; i < kRest; ++i) level->step();
    ASSERT_TRUE(level->has_budgets());
    level->for_shadows([](LightShadow& shadow) { shadow.enabled = false; });
    level->world.patch<LightShadow>(level->spawned.lights.front().entity,
                                    [](LightShadow& shadow) { shadow.enabled = true; });
    for (int i = 0; i < kRest; ++i) level->step();
    EXPECT_GT(level->device.map_bytes(), 0u);
    EXPECT_FALSE(level->has_budgets());
}

TEST_F(AutomaticLimit, LeavesWhatIsGiven) {
    start();
    constexpr std::uint32_t kGiven_px = 1024;
    level->for_shadows([](LightShadow& shadow) { shadow.resolution_px = kGiven_px; });
    for (int i = 0; i < kRest; ++i) level->step();
    EXPECT_GT(level->device.map_bytes(), shadow::kAutomatic_bytes);
    EXPECT_EQ(level->limited(), 0u);
}

TEST_F(AutomaticLimit, FreesUnseenMapsWhereItIsShort) {
    start(kFewLights);
    for (int i = 0; i < kRest; ++i) level->step();
    const std::uint64_t held = level->device.map_bytes();
    ASSERT_GT(held, 0u);
    level->look_up();
    level->step();
    EXPECT_EQ(level->device.map_bytes(), held) << "there is room: looking back costs nothing";
    start();
    level->settings.shadow_budget.bytes = shadow::ShadowBudget::kUnlimited;
    for (int i = 0; i < kRest; ++i) level->step();
    const std::uint64_t all = level->device.map_bytes();
    ASSERT_GT(all, shadow::kAutomatic_bytes);
    level->look_up();
    level->step();
    EXPECT_EQ(level->device.map_bytes(), all) << "without a limit unseen maps stay";
    level->settings.shadow_budget.bytes = 0;
    level->step();
    EXPECT_LE(level->device.map_bytes(), shadow::kAutomatic_bytes) << "although no light wants a map";
    EXPECT_GT(level->device.map_bytes(), 0u) << "no more than has to go";
}

}  // namespace
}  // namespace gnomon
