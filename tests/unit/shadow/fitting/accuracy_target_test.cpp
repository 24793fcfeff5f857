#include "systems/shadow/request/accuracy_target.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/long_run.h"
#include "tests/unit/shadow/random_scene.h"

/// Maps have as many texels as LightShadow::max_error_px requires: the prediction meets it, or the map is as large as
/// it may be. Their sizes stay while a camera walks.
namespace gnomon::shadow {
namespace {

TEST(ContractSize, IsTheLeastMultipleThatKeepsTheWord) {
    EXPECT_EQ(target_size_px(1024, false, 2.0, 1.0, 4096), 1024u) << "exactly kept";
    EXPECT_EQ(target_size_px(1024, false, 3.0, 1.0, 4096), 2048u) << "twice the error of its texels";
    EXPECT_EQ(target_size_px(1024, false, 2.1, 1.0, 4096), 1280u);
    EXPECT_EQ(target_size_px(1024, false, 2.0, 4.0, 4096), 256u);
    EXPECT_EQ(target_size_px(1024, false, 5.0, 1.0, 2560), 2560u) << "no more than it may have";
}

TEST(ContractSize, IsHeldWhileItIsLessThanTwiceWhatIsNeeded) {
    EXPECT_EQ(target_size_px(1024, true, 1.51, 1.0, 4096), 1024u);
    EXPECT_EQ(target_size_px(1024, false, 1.51, 1.0, 4096), 768u) << "nothing to hold";
    EXPECT_EQ(target_size_px(1024, true, 1.50, 1.0, 4096), 512u);
    EXPECT_EQ(target_size_px(1024, true, 1.51, 1.0, 768), 768u) << "but not above what it may be";
}

TEST(ContractSize, IsTotal) {
    constexpr double kInf = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(target_size_px(1024, false, kInf, 1.0, 4096), 4096u);
    EXPECT_EQ(target_size_px(1024, false, kNan, 1.0, 4096), 4096u);
    EXPECT_EQ(target_size_px(1024, false, 0.0, 1.0, 4096), 256u) << "nothing is seen";
    EXPECT_EQ(target_size_px(1024, false, 3.0, 1e-30, 4096), 4096u);
    EXPECT_EQ(target_size_px(1024, false, 3.0, 1e30, 4096), 256u);
    EXPECT_EQ(target_size_px(100, false, 3.0, 1.0, 100), 100u) << "a device's limit";
    LightShadow shadow;
    for (const float absurd : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
        shadow.max_error_px = absurd;
        EXPECT_EQ(target_error_px(shadow), 1.0);
    }
}

class Contract : public ::testing::TestWithParam<LightKind> {
protected:
    static SceneSnapshot scene(RandomScene& random) {
        SceneSnapshot s = random.scene(GetParam());
        s.lights[0].shadow = {};
        s.lights[0].shadow.filter = ShadowFilter::hard;
        s.lights[0].shadow.cascades = 4;
        return s;
    }
    static double predicted_px(const ShadowFrame& frame) {
        double worst = 0.0;
        for (const ShadowView& view : frame.fitted.views) worst = std::max(worst, view.error.texel_edge_px);
        return worst;
    }
};

TEST_P(Contract, IsKeptByThePredictionOrTheMapIsAsLargeAsItMayBe) {
    RandomScene random(print_seed());
    int kept = 0, smaller = 0;
    for (int i = 0; i < 300; ++i) {
        SceneSnapshot s = scene(random);
        std::uint32_t finer = 1u << 20;
        for (const float wish_px : {0.5f, 1.0f, 2.0f, 4.0f, 8.0f}) {
            s.lights[0].shadow.max_error_px = wish_px;
            const ShadowFrame frame = fitted(s);
            if (frame.fitted.views.empty()) continue;
            const ShadowRequest& demand = frame.fitted.lights[0].request;
            EXPECT_LE(demand.map.resolution_px, demand.limits.max_px);
            // A step more: where fewer texels err far more than in proportion, the last of the fits requests too many.
            EXPECT_LE(demand.map.resolution_px, finer + kLeastMap_px) << "asking for less gave more";
            finer = demand.map.resolution_px;
            smaller += demand.map.resolution_px < demand.limits.max_px ? 1 : 0;
            if (!meets_target(predicted_px(frame), wish_px)) {
                EXPECT_EQ(demand.map.resolution_px, demand.limits.max_px) << wish_px;
                continue;
            }
            ++kept;
            // A step less would not do; two, where the border's share is another then.
            if (demand.map.resolution_px > 2 * kLeastMap_px) {
                s.lights[0].shadow.resolution_px = demand.map.resolution_px - 2 * kLeastMap_px;
                EXPECT_FALSE(meets_target(predicted_px(fitted(s)), wish_px)) << wish_px;
                s.lights[0].shadow.resolution_px = 0;
            }
        }
    }
    std::cout << kept << " kept, " << smaller << " by maps smaller than they might be\n";
    // A point light counts 400 on the average, give or take 33: each of 300 scenes counts up to five times.
    EXPECT_GT(kept, 150) << "the test says something";
    EXPECT_GT(smaller, 50);
}

TEST_P(Contract, FindsTheSameAgainWhileNothingChanges) {
    RandomScene random(print_seed());
    for (int i = 0; i < 100; ++i) {
        const SceneSnapshot s = scene(random);
        const ShadowFrame first = fitted(s);
        History previous = first.next_history;
        for (std::uint32_t f = 0; f < kSpareFrames + 4; ++f) {
            const ShadowFrame next = fitted(s, previous);
            ASSERT_EQ(first.fitted.lights[0].request.map.resolution_px, next.fitted.lights[0].request.map.resolution_px) << f;
            previous = next.next_history;
        }
    }
}

TEST_P(Contract, KeepsItsSizeWhileTheCameraSways) {
    RandomScene random(print_seed());
    for (int i = 0; i < 40; ++i) {
        SceneSnapshot s = scene(random);
        s.lights[0].shadow.max_error_px = 4.0f;
        const glm::dvec3 from = s.consumers[0].position_ws_m;
        History previous;
        std::uint32_t last = 0;
        int shrinks = 0;
        for (int f = 0; f < 60; ++f) {
            s.consumers[0].position_ws_m = from * (1.0 + 0.02 * std::sin(0.9 * f));  // seven frames to and fro
            const ShadowFrame frame = fitted(s, previous);
            previous = frame.next_history;
            if (frame.fitted.views.empty()) continue;
            const std::uint32_t size = frame.fitted.lights[0].request.map.resolution_px;
            shrinks += last > size ? 1 : 0;
            last = size;
        }
        EXPECT_EQ(shrinks, 0);
    }
}

TEST_P(Contract, GivesUpTexelsASecondAfterTheyWereNeeded) {
    // 1076: what twice the texels err by promises that half of them do, again and again.
    for (const std::uint64_t seed : {print_seed(), std::uint64_t{1076}}) {
        RandomScene random(seed);
        int given_up = 0;
        for (int i = 0; i < 40; ++i) {
            SceneSnapshot s = scene(random);
            s.lights[0].shadow.max_error_px = 1.0f;
            const ShadowFrame fine = fitted(s);
            s.lights[0].shadow.max_error_px = 8.0f;
            const std::uint32_t before = fine.fitted.lights[0].request.map.resolution_px, enough = fitted(s).fitted.lights[0].request.map.resolution_px;
            if (fine.fitted.views.empty() || enough > before / 2) continue;
            History previous = fine.next_history;
            for (std::uint32_t f = 1; f < kSpareFrames; ++f) {
                const ShadowFrame frame = fitted(s, previous);
                ASSERT_EQ(frame.fitted.lights[0].request.map.resolution_px, before) << f;
                previous = frame.next_history;
            }
            const ShadowFrame after = fitted(s, previous);
            EXPECT_LE(after.fitted.lights[0].request.map.resolution_px, before);  // half is tried, and may be too small
            given_up += after.fitted.lights[0].request.map.resolution_px < before ? 1 : 0;
            EXPECT_TRUE(meets_target(predicted_px(after), 8.0));
            s.lights[0].shadow.max_error_px = 1.0f;
            const ShadowFrame again = fitted(s, after.next_history);
            EXPECT_TRUE(meets_target(predicted_px(again), 1.0) ||
                        again.fitted.lights[0].request.map.resolution_px == again.fitted.lights[0].request.limits.max_px)
                << "more are given at once: scene " << i << ", " << again.fitted.lights[0].request.map.resolution_px << " of "
                << again.fitted.lights[0].request.limits.max_px << " px, " << predicted_px(again) << " px off";
        }
        EXPECT_GT(given_up, 5);
    }
}

/// Checks that a size that seems to do, and proves too small when it is tried, is not tried again and again.
TEST_P(Contract, ComesToRest) {
    // Seed 1072: with half of the texels the error is seven times as large, so that twice the size is requested again.
    const int scenes = kSanitized ? 1 : is_long_run() ? 60 : 12;
    int tried_in_vain = 0;
    for (const std::uint64_t seed : {print_seed(), std::uint64_t{1072}}) {
        RandomScene random(seed);
        for (int i = 0; i < scenes; ++i) {
            SceneSnapshot s = scene(random);
            s.lights[0].shadow.filter = ShadowFilter::pcf_grid;
            s.lights[0].tuning.kernel.size_texel = 15;  // a border of a sixteenth of the smallest map
            float& wish_px = s.lights[0].shadow.max_error_px;
            const auto size = [&] { return fitted(s).fitted.lights[0].request.map.resolution_px; };
            for (wish_px = 0.125f; wish_px < 64.0f && size() > 2 * kLeastMap_px; wish_px *= 1.1f) {
            }
            const ShadowFrame fine = fitted(s);
            if (fine.fitted.views.empty() || fine.fitted.lights[0].request.map.resolution_px != 2 * kLeastMap_px) continue;
            for (int step = 0; step < 12; ++step) {
                wish_px *= 1.1f;
                History previous = fine.next_history;
                // A size may be tried for so long, and another one be kept as long after it.
                for (std::uint32_t f = 0; f < 3 * kSpareFrames; ++f) previous = fitted(s, previous).next_history;
                EXPECT_TRUE(fitted(s, previous).next_history == previous) << i;
                tried_in_vain += previous.lights[0].size.downsize_frames > kSpareFrames ? 1 : 0;
            }
        }
    }
    if (GetParam() != LightKind::point) {  // a cube's faces have no border
        EXPECT_GT(tried_in_vain, 0) << "the test says something";
    }
}

TEST_P(Contract, LeavesASizeAloneThatIsGivenOrMustNotFollowWhatIsSeen) {
    RandomScene random(print_seed());
    for (int i = 0; i < 20; ++i) {
        SceneSnapshot s = scene(random);
        LightShadow& shadow = s.lights[0].shadow;
        shadow.max_error_px = 1000.0f;
        shadow.resolution_px = 1000;
        EXPECT_EQ(fitted(s).fitted.lights[0].request.map.resolution_px, 1000u);
        shadow.resolution_px = 0;
        shadow.filter = ShadowFilter::pcss;
        s.lights[0].source_radius_m = s.lights[0].sun_radius_rad = 0.1f;
        const ShadowFrame soft = fitted(s);
        EXPECT_EQ(soft.fitted.lights[0].request.map.resolution_px, soft.fitted.lights[0].request.limits.max_px);
        shadow.filter = ShadowFilter::hard;
        s.lights[0].tuning.cascades.fit = ShadowFit::stable;
        const ShadowFrame stable = fitted(s);
        if (GetParam() == LightKind::directional) {
            EXPECT_EQ(stable.fitted.lights[0].request.map.resolution_px, stable.fitted.lights[0].request.limits.max_px);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(EachKind, Contract,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point));

}  // namespace
}  // namespace gnomon::shadow
