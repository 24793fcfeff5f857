#include "systems/shadow/request/filter_choice.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/request/accuracy_target.h"
#include "tests/unit/shadow/random_scene.h"

/// A light that names no filter has the usual one, or exact where it has targets that the usual one's maps miss. Either
/// stays while a camera walks.
namespace gnomon::shadow {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN(), kEndless = std::numeric_limits<double>::infinity();
constexpr AccuracyTargets kOfEdges{2.0, 0.0}, kOfWidth{0.0, 2.0}, kBothTargets{2.0, 2.0};

/// Maps with that error of edges, beside the picture's own pixel, and that width of what they resolve.
constexpr MapAccuracy stated_maps(double edge_px, double resolved_px) { return {edge_px + 1.0, 1.0, resolved_px}; }

TEST(FilterChoice, IsTheUsualOneAsLongAsItsMapsMeetTheTarget) {
    EXPECT_EQ(chosen_filter({}, stated_maps(2.0, 9.0), kOfEdges), kDefaultFilter);
    EXPECT_EQ(chosen_filter({}, stated_maps(2.01, 0.0), kOfEdges), kExactFilter);
    EXPECT_EQ(chosen_filter({}, stated_maps(9.0, 2.0), kOfWidth), kDefaultFilter);
    EXPECT_EQ(chosen_filter({}, stated_maps(0.0, 2.01), kOfWidth), kExactFilter);
    EXPECT_EQ(chosen_filter({}, stated_maps(2.0, 2.0), kBothTargets), kDefaultFilter);
    EXPECT_EQ(chosen_filter({}, stated_maps(2.01, 2.0), kBothTargets), kExactFilter);
    EXPECT_EQ(chosen_filter({}, stated_maps(2.0, 2.01), kBothTargets), kExactFilter);
    EXPECT_EQ(chosen_filter({}, {2.01, 0.0, 0.0}, kOfEdges), kExactFilter) << "no pixel of the picture's in it";
    EXPECT_EQ(chosen_filter({kDefaultFilter, kOfEdges, {}}, stated_maps(2.0, 9.0), kOfEdges), kDefaultFilter);
    EXPECT_EQ(chosen_filter({kDefaultFilter, kOfEdges, {}}, stated_maps(2.01, 9.0), kOfEdges), kExactFilter);
    for (const double bad : {kNoNumber, kEndless}) {
        EXPECT_EQ(chosen_filter({}, stated_maps(bad, 0.0), kOfEdges), kExactFilter);
        EXPECT_EQ(chosen_filter({}, stated_maps(0.0, bad), kOfWidth), kExactFilter);
    }
}

TEST(FilterChoice, ComesBackOnceTheUsualOneErrsByLessThanItMay) {
    const FilterHistory keeping{kExactFilter, kBothTargets, {}};
    EXPECT_EQ(chosen_filter(keeping, stated_maps(1.42, 1.0), kBothTargets), kExactFilter);
    EXPECT_EQ(chosen_filter(keeping, stated_maps(1.0, 1.42), kBothTargets), kExactFilter);
    EXPECT_EQ(chosen_filter(keeping, stated_maps(1.41, 1.41), kBothTargets), kDefaultFilter);
    EXPECT_EQ(chosen_filter(keeping, stated_maps(2.9, 1.9), {3.0, 2.0}), kDefaultFilter)
        << "another word: nothing is previous of it";
    EXPECT_EQ(chosen_filter(keeping, stated_maps(1.9, 2.9), {2.0, 3.0}), kDefaultFilter);
}

TEST(FilterChoice, IsTriedAgainASecondAfterWhatIsSeenChangedAndNotBefore) {
    const MapAccuracy usual = stated_maps(9.0, 4.0), later = stated_maps(8.0, 4.0);
    FilterHistory previous = exact_history({}, usual, false, 1.0, kOfEdges);
    EXPECT_EQ(previous.filter, kExactFilter);
    EXPECT_EQ(previous.frames, kFilterFrames);
    for (std::uint32_t frame = kFilterFrames; frame > 1; --frame) {
        EXPECT_FALSE(is_trial_due(previous, kOfEdges)) << frame;
        previous = exact_history(previous, usual, false, 1.0 + frame, kOfEdges);
    }
    EXPECT_TRUE(is_trial_due(previous, kOfEdges));
    previous = exact_history(previous, later, false, previous.seen_px, kOfEdges);
    EXPECT_EQ(previous.frames, 0u) << "all is as it was: at rest";
    EXPECT_FALSE(is_trial_due(previous, kOfEdges));
    EXPECT_EQ(exact_history(previous, later, false, previous.seen_px, kOfEdges), previous);
    EXPECT_EQ(exact_history(previous, later, false, previous.seen_px + 1.0, kOfEdges).frames, kFilterFrames);
    EXPECT_TRUE(is_trial_due(previous, {2.5, 0.0})) << "another word";
    EXPECT_TRUE(is_trial_due(previous, kBothTargets)) << "another word";
}

TEST(FilterChoice, ComesBackOnlyAfterEveryFrameOfHalfASecondPassed) {
    FilterHistory previous{kExactFilter, kOfEdges, stated_maps(9.0, 4.0), 1.0, 1, 0};
    for (std::uint32_t pass = 1; pass < kFilterPasses; ++pass) {
        EXPECT_TRUE(is_trial_due(previous, kOfEdges));
        EXPECT_FALSE(comes_back(previous, kOfEdges)) << pass;
        EXPECT_TRUE(comes_back(previous, kOfWidth)) << "another word: at once";
        previous = exact_history(previous, stated_maps(1.0, 4.0), true, 1.0, kOfEdges);
    }
    EXPECT_TRUE(comes_back(previous, kOfEdges));
    previous = exact_history(previous, stated_maps(9.0, 4.0), false, 1.0, kOfEdges);
    EXPECT_EQ(previous.passed, 0u);
    EXPECT_EQ(previous.frames, kFilterFrames) << "one that fails ends it";
    EXPECT_FALSE(is_trial_due(previous, kOfEdges));
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
        EXPECT_TRUE(leaves(light, [](LightShadow& s) { s = {.narrowest_caster_px = 2.0f}; }));
        EXPECT_FALSE(leaves(light, [](LightShadow& s) { s = {.narrowest_caster_px = -2.0f}; }));
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
    const FilterHistory keeping{kExactFilter, kOfEdges, {}};
    EXPECT_EQ(filter_to_fit(lamp, nullptr), kDefaultFilter);
    for (const LightKind kind : {LightKind::rectangle, LightKind::disc, LightKind::sphere, LightKind::tube}) {
        LightItem area = lamp;
        area.kind = kind;
        area.shadow.max_error_px = 0.01f;
        EXPECT_EQ(filter_to_fit(area, nullptr), ShadowFilter::pcss) << "no target chooses another";
        area.shadow.filter = ShadowFilter::hard;
        EXPECT_EQ(filter_to_fit(area, nullptr), ShadowFilter::hard);
    }
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
        s.lights[0].shadow = {.narrowest_caster_px = wish_px};
        return s;
    }
    static ShadowFilter filter(const ShadowFrame& frame) { return frame.fitted.lights[0].request.map.filter; }
    static double resolved_in(const ShadowFrame& frame) {
        double worst = 0.0;
        for (const ShadowView& view : frame.fitted.views)
            if (!view.lit) worst = std::max(worst, accuracy_of(view).resolved_px);
        return worst;
    }
    /// Returns the largest error of edges, apart from what the picture's own grid causes.
    static double error_in(const ShadowFrame& frame) {
        double worst = 0.0;
        for (const ShadowView& view : frame.fitted.views)
            if (!view.lit) worst = std::max(worst, accuracy_of(view).edge_px - accuracy_of(view).grid_px);
        return worst;
    }
    static bool is_named_kept(SceneSnapshot s) {
        s.lights[0].shadow.filter = kDefaultFilter;
        return resolved_in(fitted(s)) <= static_cast<double>(s.lights[0].shadow.narrowest_caster_px);
    }
};

TEST_P(FittedFilter, IsExactWhereTheUsualOnesMapsMissTheTarget) {
    RandomScene random(print_seed());
    int usual = 0, keeping = 0, more_cascades = 0;
    for (int i = 0; i < 100; ++i)
        for (const float wish_px : {0.25f, 1.0f, 4.0f}) {
            const SceneSnapshot s = scene(random, wish_px);
            const ShadowFrame frame = fitted(s);
            if (frame.fitted.views.empty()) continue;
            const bool kept = is_named_kept(s);
            if (filter(frame) == kDefaultFilter) {
                ++usual;
                EXPECT_LE(resolved_in(frame), wish_px) << "no other is needed";
                more_cascades += kept ? 0 : 1;
                EXPECT_EQ(frame.fitted.lights[0].default_filter, MapAccuracy{});
                continue;
            }
            ++keeping;
            EXPECT_EQ(filter(frame), kExactFilter);
            EXPECT_FALSE(kept);
            EXPECT_TRUE(frame.fitted.lights[0].request.rays.used);
            EXPECT_GT(frame.fitted.lights[0].default_filter.resolved_px, wish_px) << "the number behind it";
        }
    std::cout << usual << " have the usual filter, " << more_cascades << " of them by another number of cascades, "
              << keeping << " the keeping one\n";
    EXPECT_GT(usual, 20);
    EXPECT_GT(keeping, 20);
}

TEST_P(FittedFilter, IsTheUsualOneForEdgesThatItsWalksKeepWhateverItsTexels) {
    RandomScene random(print_seed());
    int fitted_lights = 0, coarse = 0;
    for (int i = 0; i < 40; ++i) {
        SceneSnapshot s = scene(random, 0.0f);
        for (const auto& [wish_px, kept] : {std::pair(1.0f, kDefaultFilter), std::pair(0.5f, kExactFilter)}) {
            s.lights[0].shadow = {.max_error_px = wish_px};
            const ShadowFrame frame = fitted(s);
            if (frame.fitted.views.empty()) continue;
            EXPECT_EQ(filter(frame), kept) << wish_px;
            ++fitted_lights;
            coarse += kept == kDefaultFilter && resolved_in(frame) > 1.0 ? 1 : 0;
        }
    }
    EXPECT_GT(fitted_lights, 40);
    EXPECT_GT(coarse, 5) << "texels would have broken it";
}

TEST_P(FittedFilter, IsTheKeepingOneForEdgesOfCastersByDepth) {
    RandomScene random(print_seed());
    int turned = 0;
    for (int i = 0; i < 40; ++i) {
        SceneSnapshot s = scene(random, 0.0f);
        s.lights[0].shadow = {.max_error_px = 1.0f};
        EXPECT_EQ(filter(fitted(s)), kDefaultFilter) << "walks find edges by any texels";
        s.drawables.any_by_depth = true;
        for (auto& instance : s.instances) instance.drawable.by_depth = true;
        SceneSnapshot named = s;
        named.lights[0].shadow.filter = kDefaultFilter;
        const bool breaks = error_in(fitted(named)) > 1.0;
        EXPECT_EQ(filter(fitted(s)), breaks ? kExactFilter : kDefaultFilter) << i;
        turned += breaks ? 1 : 0;
    }
    EXPECT_GT(turned, 5);
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
        broken += resolved_in(frame) <= 0.5 ? 0 : 1;
    }
    EXPECT_GT(broken, 10) << "another filter would have been chosen, had a pixel been said";
}

TEST_P(FittedFilter, HardlyChangesWhileTheCameraSways) {
    RandomScene random(print_seed());
    int changes = 0, keeping = 0, twice_there = 0;
    for (int i = 0; i < 30; ++i) {
        SceneSnapshot s = scene(random, 2.0f);
        const glm::dvec3 from = s.consumers[0].position_ws_m;
        History previous;
        int of_scene = 0;
        ShadowFilter last = ShadowFilter::automatic;
        for (int f = 0; f < 200; ++f) {
            s.consumers[0].position_ws_m = from * (1.0 + 0.02 * std::sin(0.9 * f));  // seven frames to and fro
            const ShadowFrame frame = fitted(s, previous);
            previous = frame.next_history;
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
        SceneSnapshot s = scene(random, 0.5f);
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
        History previous = near.next_history;
        stand(30.0);
        for (std::uint32_t f = 1; f < kFilterFrames + kFilterPasses - 1; ++f) {
            const ShadowFrame frame = fitted(s, previous);
            ASSERT_EQ(filter(frame), kExactFilter) << f;
            previous = frame.next_history;
        }
        const ShadowFrame again = fitted(s, previous);
        back += filter(again) == kDefaultFilter ? 1 : 0;
        EXPECT_EQ(filter(again) == kDefaultFilter, resolved_in(far) <= 0.5 / kFilterHysteresis);
    }
    EXPECT_GT(there, 5);
    EXPECT_GT(back, 5);
}

TEST_P(FittedFilter, ComesToRest) {
    RandomScene random(print_seed());
    for (int i = 0; i < 40; ++i) {
        const SceneSnapshot s = scene(random, 0.5f);
        History previous;
        for (std::uint32_t f = 0; f < 2 * kFilterFrames + 4; ++f) previous = fitted(s, previous).next_history;
        EXPECT_EQ(fitted(s, previous).next_history, previous) << i;
    }
}

/// Checks that a light takes nothing that a budget has not shared out.
TEST_P(FittedFilter, WaitsForTheNextFrameWithinABudget) {
    RandomScene random(print_seed());
    int waited = 0;
    for (int i = 0; i < 40; ++i) {
        const SceneSnapshot s = scene(random, 0.25f);
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
