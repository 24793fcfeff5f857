#include "systems/shadow/request/filter_choice.h"

#include <gtest/gtest.h>

#include <limits>

#include "systems/shadow/request/accuracy_target.h"
#include "tests/unit/shadow/random_scene.h"

/// A light that names no filter has the usual one, or the one that keeps max_error_px where that is said and the usual
/// one's maps do not; and what it has stays while a camera walks.
namespace gnomon::shadow {
namespace {

/// A map's share of an error that is beside the pixel of the picture's own.
constexpr double px(double of_texels_px) { return of_texels_px + 1.0; }

TEST(FilterChoice, IsTheUsualOneAsLongAsItsMapsKeepTheWord) {
    EXPECT_EQ(chosen_filter({}, px(2.0), 2.0), kDefaultFilter);
    EXPECT_EQ(chosen_filter({}, px(2.01), 2.0), kExactFilter);
    EXPECT_EQ(chosen_filter({kDefaultFilter, 2.0}, px(2.0), 2.0), kDefaultFilter);
    EXPECT_EQ(chosen_filter({kDefaultFilter, 2.0}, px(2.01), 2.0), kExactFilter);
    EXPECT_EQ(chosen_filter({}, std::numeric_limits<double>::quiet_NaN(), 2.0), kExactFilter);
    EXPECT_EQ(chosen_filter({}, std::numeric_limits<double>::infinity(), 1e9), kExactFilter);
}

TEST(FilterChoice, ComesBackOnceTheUsualOneErrsByLessThanItMay) {
    const FilterHistory keeping{kExactFilter, 2.0};
    EXPECT_EQ(chosen_filter(keeping, px(1.42), 2.0), kExactFilter);
    EXPECT_EQ(chosen_filter(keeping, px(1.41), 2.0), kDefaultFilter);
    EXPECT_EQ(chosen_filter(keeping, px(2.9), 3.0), kDefaultFilter) << "another word: nothing is held of it";
}

TEST(FilterChoice, IsTriedAgainASecondAfterWhatIsSeenChangedAndNotBefore) {
    FilterHistory held = exact_history({}, 9.0, false, 1.0, 2.0);
    EXPECT_EQ(held.filter, kExactFilter);
    EXPECT_EQ(held.frames, kFilterFrames);
    for (std::uint32_t frame = kFilterFrames; frame > 1; --frame) {
        EXPECT_FALSE(is_trial_due(held, 2.0)) << frame;
        held = exact_history(held, 9.0, false, 1.0 + frame, 2.0);
    }
    EXPECT_TRUE(is_trial_due(held, 2.0));
    held = exact_history(held, 8.0, false, held.seen_px, 2.0);
    EXPECT_EQ(held.frames, 0u) << "all is as it was: at rest";
    EXPECT_FALSE(is_trial_due(held, 2.0));
    EXPECT_EQ(exact_history(held, 8.0, false, held.seen_px, 2.0), held);
    EXPECT_EQ(exact_history(held, 8.0, false, held.seen_px + 1.0, 2.0).frames, kFilterFrames);
    EXPECT_TRUE(is_trial_due(held, 2.5)) << "another word";
}

TEST(FilterChoice, ComesBackOnlyAfterEveryFrameOfHalfASecondPassed) {
    FilterHistory held{kExactFilter, 2.0, 9.0, 1.0, 1, 0};
    for (std::uint32_t pass = 1; pass < kFilterPasses; ++pass) {
        EXPECT_TRUE(is_trial_due(held, 2.0));
        EXPECT_FALSE(comes_back(held, 2.0)) << pass;
        EXPECT_TRUE(comes_back(held, 2.5)) << "another word: at once";
        held = exact_history(held, 1.0, true, 1.0, 2.0);
    }
    EXPECT_TRUE(comes_back(held, 2.0));
    held = exact_history(held, 9.0, false, 1.0, 2.0);
    EXPECT_EQ(held.passed, 0u);
    EXPECT_EQ(held.frames, kFilterFrames) << "one that fails ends it";
    EXPECT_FALSE(is_trial_due(held, 2.0));
}

TEST(FilterChoice, IsTheContractsOnlyWhereNothingElseIsNamed) {
    LightItem sun, lamp;
    sun.kind = LightKind::directional;
    lamp.kind = LightKind::spot;
    sun.shadow = lamp.shadow = {.max_error_px = 2.0f};
    EXPECT_TRUE(leaves_filter(sun));
    EXPECT_TRUE(leaves_filter(lamp));
    const auto leaves = [](LightItem light, auto change) {
        if constexpr (std::is_invocable_v<decltype(change), ShadowTuning&>)
            change(light.tuning);
        else
            change(light.shadow);
        return leaves_filter(light);
    };
    for (LightItem light : {sun, lamp}) {
        EXPECT_FALSE(leaves(light, [](LightShadow& s) { s.max_error_px = 0.0f; })) << "nothing is said";
        EXPECT_FALSE(leaves(light, [](LightShadow& s) { s.filter = ShadowFilter::triangles; }));
        EXPECT_FALSE(leaves(light, [](LightShadow& s) { s.resolution_px = 512; }));
        EXPECT_FALSE(leaves(light, [](ShadowTuning& t) { t.projection.near_m = 0.5f; }));
        EXPECT_FALSE(leaves(light, [](ShadowTuning& t) { t.projection.far_m = 9.0f; }));
        EXPECT_FALSE(leaves(light, [](ShadowTuning& t) { t.bias.mode = BiasMode::constant; }));
        EXPECT_TRUE(leaves(light, [](LightShadow& s) { s.cascades = 2; }));
    }
    EXPECT_FALSE(leaves(sun, [](ShadowTuning& t) { t.projection.kind = LightProjection::perspective; }));
    EXPECT_FALSE(leaves(sun, [](ShadowTuning& t) { t.cascades.fit = ShadowFit::stable; }));
    EXPECT_TRUE(leaves(lamp, [](ShadowTuning& t) { t.cascades.fit = ShadowFit::stable; })) << "of suns alone";
    const FilterHistory keeping{kExactFilter, 2.0};
    EXPECT_EQ(filter_to_fit(lamp, nullptr), kDefaultFilter);
    EXPECT_EQ(filter_to_fit(lamp, &keeping), kExactFilter);
    lamp.shadow.max_error_px = 0.0f;
    EXPECT_EQ(filter_to_fit(lamp, &keeping), kDefaultFilter);
    lamp.shadow.filter = ShadowFilter::pcss;
    EXPECT_EQ(filter_to_fit(lamp, &keeping), ShadowFilter::pcss);
}

class FittedFilter : public ::testing::TestWithParam<LightKind> {
protected:
    static SceneSnapshot scene(RandomScene& random, float wish_px) {
        SceneSnapshot s = random.scene(GetParam());
        s.lights[0].shadow = {.max_error_px = wish_px};
        return s;
    }
    static ShadowFilter filter(const ShadowFrame& frame) { return frame.fitted.lights[0].request.map.filter; }
    static double looked_up_px(const ShadowFrame& frame) {
        double worst = 0.0;
        for (const ShadowView& view : frame.fitted.views)
            if (!view.lit) worst = std::max(worst, view.error.edge_px);
        return worst;
    }
    static bool is_named_kept(SceneSnapshot s) {
        s.lights[0].shadow.filter = kDefaultFilter;
        return meets_target(looked_up_px(fitted(s)), target_error_px(s.lights[0].shadow));
    }
};

TEST_P(FittedFilter, IsTheKeepingOneExactlyWhereTheUsualOnesMapsDoNotKeepTheWord) {
    RandomScene random(print_seed());
    int usual = 0, keeping = 0, more_cascades = 0;
    for (int i = 0; i < 100; ++i)
        for (const float wish_px : {0.5f, 2.0f, 8.0f}) {
            const SceneSnapshot s = scene(random, wish_px);
            const ShadowFrame frame = fitted(s);
            if (frame.fitted.views.empty()) continue;
            const bool kept = is_named_kept(s);
            if (filter(frame) == kDefaultFilter) {
                ++usual;
                EXPECT_TRUE(meets_target(looked_up_px(frame), wish_px)) << "no other is needed";
                more_cascades += kept ? 0 : 1;
                EXPECT_EQ(frame.fitted.lights[0].default_filter_error_px, 0.0);
                continue;
            }
            ++keeping;
            EXPECT_EQ(filter(frame), kExactFilter);
            EXPECT_FALSE(kept);
            EXPECT_TRUE(frame.fitted.lights[0].request.rays.used);
            EXPECT_FALSE(meets_target(frame.fitted.lights[0].default_filter_error_px, wish_px)) << "the number behind it";
        }
    std::cout << usual << " have the usual filter, " << more_cascades << " of them by another number of cascades, "
              << keeping << " the keeping one\n";
    EXPECT_GT(usual, 20);
    EXPECT_GT(keeping, 20);
}

TEST_P(FittedFilter, IsTheUsualOneAsItEverWasWhereNothingIsSaid) {
    RandomScene random(print_seed());
    int broken = 0;
    for (int i = 0; i < 60; ++i) {
        SceneSnapshot s = scene(random, 0.0f);
        const ShadowFrame frame = fitted(s);
        s.lights[0].shadow.filter = kDefaultFilter;
        const ShadowFrame named = fitted(s);
        EXPECT_EQ(filter(frame), kDefaultFilter);
        EXPECT_EQ(frame.fitted.lights[0].request.map.resolution_px, named.fitted.lights[0].request.map.resolution_px);
        EXPECT_EQ(frame.next_history, named.next_history);
        broken += meets_target(looked_up_px(frame), 1.0) ? 0 : 1;
    }
    EXPECT_GT(broken, 10) << "another filter would have been chosen, had a pixel been said";
}

TEST_P(FittedFilter, HardlyChangesWhileTheCameraSways) {
    RandomScene random(print_seed());
    int changes = 0, keeping = 0, twice_there = 0;
    for (int i = 0; i < 30; ++i) {
        SceneSnapshot s = scene(random, 4.0f);
        const glm::dvec3 from = s.consumers[0].position_ws_m;
        History held;
        int of_scene = 0;
        ShadowFilter last = ShadowFilter::automatic;
        for (int f = 0; f < 200; ++f) {
            s.consumers[0].position_ws_m = from * (1.0 + 0.02 * std::sin(0.9 * f));  // seven frames to and fro
            const ShadowFrame frame = fitted(s, held);
            held = frame.next_history;
            if (frame.fitted.views.empty()) continue;
            of_scene += last != ShadowFilter::automatic && last != filter(frame) ? 1 : 0;
            last = filter(frame);
        }
        EXPECT_LE(of_scene, 3) << "there, once back, and there for good";
        twice_there += of_scene == 3 ? 1 : 0;
        changes += of_scene;
        keeping += last == kExactFilter ? 1 : 0;
    }
    EXPECT_LE(twice_there, 1) << "there, and at most once back";
    std::cout << changes << " changes, " << keeping << " end with the keeping one\n";
}

TEST_P(FittedFilter, ChangesAtOnceForTheWordAndComesBackASecondAfterItWasNeeded) {
    RandomScene random(print_seed());
    int there = 0, back = 0;
    for (int i = 0; i < 60; ++i) {
        SceneSnapshot s = scene(random, 1.0f);
        const glm::dvec3 near_m = s.consumers[0].position_ws_m;
        s.consumers[0].far_m = 1e5;
        const auto stand = [&](double times) { s.consumers[0].position_ws_m = near_m * times; };
        stand(30.0);
        const ShadowFrame far = fitted(s);
        stand(1.0);
        const ShadowFrame near = fitted(s, far.next_history);
        if (far.fitted.views.empty() || near.fitted.views.empty() || filter(far) != kDefaultFilter || filter(near) != kExactFilter)
            continue;
        ++there;
        History held = near.next_history;
        stand(30.0);
        for (std::uint32_t f = 1; f < kFilterFrames + kFilterPasses - 1; ++f) {
            const ShadowFrame frame = fitted(s, held);
            ASSERT_EQ(filter(frame), kExactFilter) << f;
            held = frame.next_history;
        }
        const ShadowFrame again = fitted(s, held);
        back += filter(again) == kDefaultFilter ? 1 : 0;
        EXPECT_EQ(filter(again) == kDefaultFilter, meets_target(looked_up_px(far), 1.0 / kFilterHysteresis));
    }
    EXPECT_GT(there, 5);
    EXPECT_GT(back, 5);
}

TEST_P(FittedFilter, ComesToRest) {
    RandomScene random(print_seed());
    for (int i = 0; i < 40; ++i) {
        const SceneSnapshot s = scene(random, 1.0f);
        History held;
        for (std::uint32_t f = 0; f < 2 * kFilterFrames + 4; ++f) held = fitted(s, held).next_history;
        EXPECT_EQ(fitted(s, held).next_history, held) << i;
    }
}

/// What a budget has not shared out is not taken.
TEST_P(FittedFilter, WaitsForTheNextFrameWithinABudget) {
    RandomScene random(print_seed());
    int waited = 0;
    for (int i = 0; i < 40; ++i) {
        const SceneSnapshot s = scene(random, 0.5f);
        if (const ShadowFrame now = fitted(s); now.fitted.views.empty() || filter(now) != kExactFilter) continue;
        const ShadowFrame first = fitted(s, {}, true);
        EXPECT_EQ(filter(first), kDefaultFilter);
        EXPECT_EQ(filter(fitted(s, first.next_history, true)), kExactFilter);
        ++waited;
    }
    EXPECT_GT(waited, 10);
}

INSTANTIATE_TEST_SUITE_P(EachKind, FittedFilter,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point));

}  // namespace
}  // namespace gnomon::shadow
