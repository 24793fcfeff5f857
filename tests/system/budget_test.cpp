#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "bench/scaling/many_lights_scene.h"
#include "engine/math/frustum.h"
#include "gnomon/components.h"
#include "gnomon/light.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/frame_system.h"
#include "tests/long_run.h"
#include "tests/system/timed_device.h"

/// The level of ./gnomon bench demand, 200 shadowed lights in it, within a budget.
namespace gnomon {
namespace {

constexpr std::uint64_t kSeed = 7, kBytes = 64u << 20;
constexpr float kGpu_ms = 4.0f;
constexpr int kSettled = 60;

/// What a light was granted.
using Rung = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, bool>;
Rung rung_of(const BudgetReport& budget) { return {budget.px, budget.views, budget.refresh_frames, budget.plain}; }

bool is_shed(const LightReport& light) {
    return light.reason == Reason::over_budget || light.reason == Reason::budget_shrunk;
}

struct Level {
    explicit Level(TimedDevice& on, std::uint32_t lights = 200) : device(on) {
        spawned = game::spawn_scene(bench::demand_scene(lights, kSeed), world, library);
        frame = std::move(FrameSystem::create(device, library)).value();
        camera = spawned.cameras.front().entity;
        settings.shadow_budget = {kBytes, kGpu_ms};
    }
    const FrameReport& step() {
        frame->run(world, settings);
        return frame->report();
    }
    /// Moves the camera to where everything is seen: above, looking down.
    void look_down() {
        world.patch<Transform>(camera, [](Transform& t) {
            t.translation_m = {0.0, 90.0, 40.0};
            t.rotation = glm::quat_cast(math::basis_from_back(glm::dvec3(0.0, 90.0, 40.0)));
        });
    }
    void walk(double by_m) {
        world.patch<Transform>(camera, [by_m](Transform& t) { t.translation_m.z -= by_m; });
    }
    std::map<std::string, Rung> rungs() const {
        std::map<std::string, Rung> all;
        for (const LightReport& light : frame->report().lights)
            if (light.budget) all[light.name] = rung_of(*light.budget);
        return all;
    }

    TimedDevice& device;
    assets::MeshLibrary library;
    ecs::Registry world;
    game::SpawnedScene spawned;
    ecs::Entity camera;
    std::unique_ptr<FrameSystem> frame;
    FrameSettings settings{.viewport_px = {1280, 720}, .exposure_ev = 5.0f};
};

class Budgets : public ::testing::Test {
protected:
    void TearDown() override {
        level.reset();
        device.recording.check_leaks();
        for (const gl::Finding& f : device.recording.findings())
            ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
    }
    Level& start(std::uint32_t lights = 200) {
        level = std::make_unique<Level>(device, lights);
        return *level;
    }
    void make_slower(double lighting, double drawing) {
        TimedDevice::Speeds& s = device.speeds;
        for (double* speed : {&s.shaded_pixel, &s.plain_pixel, &s.filtered_pixel}) *speed *= lighting;
        for (double* speed : {&s.pass, &s.draw, &s.triangle, &s.texel}) *speed *= drawing;
    }
    TimedDevice device;
    std::unique_ptr<Level> level;
};

struct Case {
    const char* name;
    bool from_above;
    double lighting, drawing;  // how much slower the device is than the model takes it to be
};
class SettledBudgets : public Budgets, public ::testing::WithParamInterface<Case> {};

TEST_P(SettledBudgets, HoldTwoHundredShadowedLightsWithin60Frames) {
    make_slower(GetParam().lighting, GetParam().drawing);
    start();
    if (GetParam().from_above) level->look_down();
    for (int i = 0; i < kSettled; ++i) {
        level->step();
        ASSERT_LE(device.map_bytes(), kBytes) << i;
    }
    const auto settled = level->rungs();
    std::size_t shed = 0;
    for (const LightReport& light : level->frame->report().lights) shed += is_shed(light) ? 1 : 0;
    std::cout << settled.size() << " lights would have maps, " << shed << " have less, "
              << static_cast<double>(device.map_bytes()) / (1 << 20) << " MiB, " << device.shadow_us() * 1.0e-3
              << " ms\n";
    EXPECT_GT(shed, 10u) << "the test says something";
    for (int i = 0; i < 300; ++i) {
        const FrameReport& report = level->step();
        ASSERT_EQ(level->rungs(), settled) << "frame " << kSettled + i;
        EXPECT_LE(device.shadow_us(), 1.02e3 * static_cast<double>(kGpu_ms));
        if (i > kSettled) {
            EXPECT_TRUE(report.still);
        }
    }
    EXPECT_LE(device.most_map_bytes, kBytes) << "not even between two calls";
    for (const LightReport& light : level->frame->report().lights) {
        if (light.keeps_max_error) {
            EXPECT_LE(light.predicted_error_px, 2.0) << light.name << " has coarser maps than it says";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, SettledBudgets,
                         ::testing::Values(Case{"AsModelled", false, 1.0, 1.0}, Case{"Slower", false, 3.0, 2.0},
                                           Case{"MuchSlower", false, 12.0, 5.0}, Case{"Faster", false, 0.3, 0.5},
                                           Case{"FromAbove", true, 1.0, 1.0}, Case{"FromAboveSlower", true, 4.0, 2.0}),
                         [](const auto& one) { return one.param.name; });

TEST_F(Budgets, DoNotOscillateWhileTheCameraWalks) {
    make_slower(2.0, 2.0);
    start();
    for (int i = 0; i < kSettled; ++i) level->step();
    struct Turns {
        double last_bytes = -1.0;
        int direction = 0, turns = 0, changes = 0;
    };
    std::map<std::string, Turns> turns;
    constexpr int kFrames = kSanitized ? 100 : 600;
    double mean_us = 0.0, stages_us = 0.0;
    for (int i = 0; i < kFrames; ++i) {
        level->walk(1.4 / 60.0);
        for (const LightReport& light : level->step().lights) {
            if (!light.budget) continue;
            Turns& t = turns[light.name];
            const auto bytes = static_cast<double>(light.budget->bytes);
            if (t.last_bytes >= 0.0 && bytes != t.last_bytes) {
                const int direction = bytes > t.last_bytes ? 1 : -1;
                ++t.changes;
                t.turns += t.direction == -direction ? 1 : 0;
                t.direction = direction;
            }
            t.last_bytes = bytes;
        }
        ASSERT_LE(device.map_bytes(), kBytes) << i;
        mean_us += device.shadow_us() / kFrames;
        stages_us += level->frame->report().shadow_cpu_us / kFrames;
    }
    int most = 0, all = 0, changes = 0;
    for (const auto& [name, t] : turns) most = std::max(most, t.turns), all += t.turns, changes += t.changes;
    std::cout << turns.size() << " lights, " << changes << " changes, " << all << " of them back, at most " << most
              << " of one light; " << mean_us * 1.0e-3 << " ms, stages " << stages_us * 1.0e-3 << " ms\n";
    EXPECT_LE(most, 6) << "in ten seconds";
    EXPECT_LE(device.most_map_bytes, kBytes);
    EXPECT_LE(mean_us, 1.02e3 * static_cast<double>(kGpu_ms));
}

/// Returns the share of the picture that a light shines on, independently of the system. Counts rays through pixels
/// that meet the ground where the light reaches.
double lit_share(const LightItem& light, const ConsumerItem& camera) {
    constexpr int kWide = 320, kHigh = 180;
    const double high = std::tan(0.5 * camera.fov_y_rad), wide = high * kWide / kHigh;
    int lit = 0;
    for (int i = 0; i < kWide * kHigh; ++i) {
        const double x = (i % kWide + 0.5) / kWide * 2.0 - 1.0, y = (i / kWide + 0.5) / kHigh * 2.0 - 1.0;
        const glm::dvec3 ray = camera.rotation_ws * glm::dvec3(x * wide, y * high, -1.0);
        if (!(ray.y < 0.0)) continue;
        const glm::dvec3 way = camera.position_ws_m - ray * (camera.position_ws_m.y / ray.y) - light.position_ws_m;
        const bool in_cone = light.kind != LightKind::spot ||
                             glm::dot(way, -light.rotation_ws[2]) > glm::length(way) * std::cos(light.outer_cone_rad);
        lit += in_cone && glm::length(way) < light.range_m ? 1 : 0;
    }
    return static_cast<double>(lit) / (kWide * kHigh);
}

/// Returns how often one of `shed` is seen less than one of `kept`: 1 always, 1/2 by chance.
double chance_that_less_is_seen(const std::vector<double>& shed, const std::vector<double>& kept) {
    double less = 0.0;
    for (const double s : shed)
        for (const double k : kept) less += s < k ? 1.0 : (s == k ? 0.5 : 0.0);
    return less / static_cast<double>(shed.size() * kept.size());
}

TEST_F(Budgets, ShedTheLeastVisibleFirst) {
    start();
    for (const std::uint64_t bytes : {512u << 10, 1u << 20, 2u << 20}) {
        level->settings.shadow_budget = {bytes, 0.0f};
        for (int i = 0; i < kSettled; ++i) level->step();
        std::vector<double> shed, kept, first, last;
        const FrameReport& report = level->frame->report();
        for (std::size_t i = 0; i < report.lights.size(); ++i) {
            const LightItem& light = level->frame->snapshot().lights[i];
            if (light.kind == LightKind::directional || !report.lights[i].budget) continue;
            // For what it takes: a point has six faces.
            const double seen =
                lit_share(light, level->frame->snapshot().consumers.front()) / report.lights[i].budget->wanted_views;
            (report.lights[i].reason == Reason::over_budget ? shed : kept).push_back(seen);
            (first.size() <= last.size() ? first : last).push_back(seen);
        }
        const double chance = chance_that_less_is_seen(shed, kept);
        std::cout << bytes / 1024 << " KiB: " << shed.size() << " of " << shed.size() + kept.size()
                  << " have no shadow; " << chance << " are seen less than those that have\n";
        ASSERT_GT(shed.size(), 3u);
        ASSERT_GT(kept.size(), 3u);
        EXPECT_GT(chance, 0.85);
        EXPECT_LT(chance_that_less_is_seen(first, last), 0.7) << "lights shed in turn are noticed";
    }
}

TEST_F(Budgets, GiveBackWhenThereIsRoom) {
    start();
    for (int i = 0; i < kSettled; ++i) level->step();
    level->settings.shadow_budget = {std::uint64_t{1} << 40, 0.0f};
    for (int i = 0; i < kSettled; ++i) level->step();
    for (const LightReport& light : level->frame->report().lights) {
        EXPECT_FALSE(is_shed(light)) << light.name;
        if (!light.budget) continue;
        EXPECT_EQ(light.budget->harm, 0.0) << light.name;
        EXPECT_EQ(light.counts.bytes - light.kept.bytes, light.budget->wanted_bytes) << light.name;
    }
    level->settings.shadow_budget = {shadow::ShadowBudget::kUnlimited};
    level->step();
    for (const LightReport& light : level->frame->report().lights) EXPECT_FALSE(light.budget) << light.name;
}

/// Halves the budget from frame to frame. The first map to become smaller has no room beside others that are still
/// large.
TEST_F(Budgets, ThatFallLeaveEachLightTheShadowThatStillHasRoom) {
    start();
    level->look_down();
    for (int i = 0; i < kSettled; ++i) level->step();
    std::size_t smaller = 0;
    for (std::uint64_t bytes = kBytes / 2; bytes >= kBytes / 32; bytes /= 2) {
        level->settings.shadow_budget = {bytes, 0.0f};
        std::map<std::string, std::uint64_t> before;
        for (const LightReport& light : level->frame->report().lights) before[light.name] = light.counts.bytes;
        for (const LightReport& light : level->step().lights) {
            const bool is_granted = light.budget && light.budget->px > 0;
            EXPECT_FALSE(is_granted && light.counts.bytes == 0) << light.name << ", of " << bytes;
            smaller += light.counts.bytes > 0 && light.counts.bytes < before[light.name] ? 1 : 0;
        }
        EXPECT_LE(device.map_bytes(), bytes);
    }
    EXPECT_GT(smaller, 20u);
}

TEST_F(Budgets, ThatHoldEverythingChangeNothing) {
    TimedDevice other_device;
    Level other(other_device, 100);
    start(100);
    level->settings.shadow_budget = {std::uint64_t{1} << 40, 1.0e6f};
    other.settings.shadow_budget = {shadow::ShadowBudget::kUnlimited};
    for (int i = 0; i < 150; ++i) {
        for (Level* l : {level.get(), &other}) {
            if (i >= 60) l->walk(0.02);
            l->step();
        }
        ASSERT_EQ(level->frame->commands(), other.frame->commands()) << i;
        ASSERT_EQ(device.map_bytes(), other_device.map_bytes()) << i;
    }
}

TEST_F(Budgets, OfARepeatableRunLearnFromNoClock) {
    make_slower(8.0, 8.0);
    start();
    level->settings.repeatable = true;
    for (int i = 0; i < kSettled; ++i) level->step();
    const auto slow = level->rungs();
    device.speeds = {};
    start();
    level->settings.repeatable = true;
    for (int i = 0; i < kSettled; ++i) level->step();
    EXPECT_EQ(level->rungs(), slow);
    device.answers = false;
    start();
    for (int i = 0; i < kSettled; ++i) level->step();
    EXPECT_EQ(level->rungs(), slow) << "without timers the model stands as well";
}

TEST_F(Budgets, LearnFromTimersThatAnswerLate) {
    make_slower(4.0, 4.0);
    device.late = 3;
    start();
    for (int i = 0; i < kSettled; ++i) level->step();
    const auto settled = level->rungs();
    for (int i = 0; i < kSettled; ++i) level->step();
    EXPECT_EQ(level->rungs(), settled);
    EXPECT_LE(device.shadow_us(), 1.02e3 * static_cast<double>(kGpu_ms));
    EXPECT_GT(device.shadow_us(), 0.25e3 * static_cast<double>(kGpu_ms)) << "it is not merely cautious";
}

TEST_F(Budgets, ADeviceWithoutRoomIsSharedOutAndGivenBackToItself) {
    device.capacity_bytes = 24u << 20;
    start();
    level->settings.shadow_budget = {shadow::ShadowBudget::kUnlimited};
    std::size_t less = 0;
    for (int i = 0; i < 3 * kSettled; ++i) {
        level->step();
        EXPECT_LE(device.map_bytes(), device.capacity_bytes);
    }
    for (const LightReport& light : level->frame->report().lights)
        less += is_shed(light) || light.reason == Reason::map_shrunk || light.reason == Reason::map_allocation_failed;
    EXPECT_GT(less, 5u);
    device.capacity_bytes = ~std::uint64_t{0};
    for (int i = 0; i < 2 * kSettled; ++i) level->step();
    for (const LightReport& light : level->frame->report().lights) {
        EXPECT_FALSE(is_shed(light)) << light.name;
        EXPECT_NE(light.reason, Reason::map_shrunk) << light.name;
        EXPECT_NE(light.reason, Reason::map_allocation_failed) << light.name;
    }
}

}  // namespace
}  // namespace gnomon
