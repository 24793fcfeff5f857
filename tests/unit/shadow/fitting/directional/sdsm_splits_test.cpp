#include "systems/shadow/fitting/directional/sdsm_splits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "systems/shadow/projection/cascade_splits.h"
#include "tests/unit/math/random_seed.h"
#include "tests/unit/not_finite.h"

/// From counts of pixels by view distance to the ends of cascades.
namespace gnomon::shadow {
namespace {

constexpr ecs::Entity kCamera{3, 1}, kOther{4, 1};

std::uint32_t bin_at(double distance_m) {
    return static_cast<std::uint32_t>(std::floor(4.0 * std::log2(distance_m)) - kFirstDepthStep);
}

SampledDepths pixels_at(std::initializer_list<double> distances_m, std::uint32_t count = 1000) {
    SampledDepths depths{.camera = kCamera};
    for (const double distance_m : distances_m) depths.pixels[bin_at(distance_m)] += count;
    return depths;
}

ConsumerItem counting_camera(CameraProjection projection = CameraProjection::perspective) {
    ConsumerItem consumer;
    consumer.entity = kCamera;
    consumer.projection = projection;
    return consumer;
}

constexpr DepthSpan kWhole{0.125, 1024.0};

CascadeSplitDistances ends_of(const SampledDepths& depths, std::uint32_t count, const ConsumerItem& consumer = counting_camera(),
                    double width_m = kInfinity) {
    CascadeSplitDistances ends{};
    EXPECT_TRUE(sampled_splits({depths, consumer, count, kWhole, width_m}, ends));
    return ends;
}

TEST(SampledDepths, CascadesEndBehindWherePixelsLie) {
    const CascadeSplitDistances ends = ends_of(pixels_at({1.0, 4.0, 500.0}), 3);
    EXPECT_EQ(ends[0], kWhole.lowest) << "the first begins at the near plane, whatever was counted";
    EXPECT_DOUBLE_EQ(ends[1], std::exp2(0.25));
    EXPECT_DOUBLE_EQ(ends[2], 4.0 * std::exp2(0.25));
    EXPECT_EQ(ends[3], kWhole.highest) << "and the last ends at the farthest receiver";
}

TEST(SampledDepths, FewPixelsGiveWayToMany) {
    SampledDepths depths = pixels_at({1.0}, 1);
    for (const double distance_m : {8.0, 16.0, 32.0}) depths.pixels[bin_at(distance_m)] = 100000;
    EXPECT_DOUBLE_EQ(ends_of(depths, 3)[1], 8.0 * std::exp2(0.25)) << "one pixel gets no cascade of its own";
}

TEST(SampledDepths, NothingIsSpentBehindTheLastPixelButTheLastCascade) {
    // Receivers reach to 1 km, pixels to 5 m: all in one cascade would have texels for a kilometre.
    EXPECT_DOUBLE_EQ(ends_of(pixels_at({2.0, 4.5}), 2)[1], 4.0 * std::exp2(0.25));
}

/// Computes the cost that sampled_splits() makes least, straight from its comment.
double suffered(const SampledSplit& split, const CascadeSplitDistances& ends) {
    const bool perspective = split.consumer.projection == CameraProjection::perspective;
    const double half = perspective ? std::tan(0.5 * split.consumer.fov_y_rad) : split.consumer.half_height_m;
    const double diagonal = 2.0 * half * std::sqrt(1.0 + 1280.0 * 1280.0 / (720.0 * 720.0));
    double sum = 0.0;
    for (std::uint32_t bin = 0; bin < kDepthBins; ++bin) {
        const double from_m = std::exp2(0.25 * (static_cast<int>(bin) + kFirstDepthStep));
        const double to_m = std::min(from_m * std::exp2(0.25), split.whole.highest);
        if (split.depths.pixels[bin] == 0) continue;
        for (std::uint32_t c = 0; c < split.count; ++c) {
            if (c + 1 < split.count && to_m > ends[c + 1] * 1.000001) continue;
            const double wide_m = std::min(perspective ? diagonal * ends[c + 1] : diagonal, split.width_m);
            const double side_m = wide_m + ends[c + 1] - ends[c];
            sum += split.depths.pixels[bin] * side_m / (perspective ? from_m : 1.0);
            break;
        }
    }
    return sum;
}

TEST(SampledDepths, NoOtherEndsAreBetter) {
    std::mt19937_64 random(print_seed());
    const auto below = [&](std::uint32_t limit) { return static_cast<std::uint32_t>(random() % limit); };
    for (int round = 0; round < 400; ++round) {
        SampledDepths depths{.camera = kCamera};
        for (std::uint32_t n = 1 + below(20); n > 0; --n) depths.pixels[84 + below(52)] += 1 + below(1000);
        const bool flat = round % 4 == 0;
        const std::uint32_t count = 1 + below(kMaxCascades);
        const ConsumerItem consumer = counting_camera(flat ? CameraProjection::orthographic : CameraProjection::perspective);
        const SampledSplit split{depths, consumer, count, kWhole, round % 3 == 0 ? kInfinity : 10.0};
        CascadeSplitDistances best{};
        ASSERT_TRUE(sampled_splits(split, best));
        const double least = suffered(split, best);
        for (std::uint32_t i = 0; i < count; ++i) EXPECT_LE(best[i], best[i + 1]);
        for (int other = 0; other < 50; ++other) {
            std::vector<std::uint32_t> bins(count - 1);
            for (std::uint32_t& bin : bins) bin = 84 + below(52);
            std::sort(bins.begin(), bins.end());
            CascadeSplitDistances ends = best;
            for (std::uint32_t i = 1; i < count; ++i)
                ends[i] = std::exp2(0.25 * (static_cast<int>(bins[i - 1]) + kFirstDepthStep));
            EXPECT_GE(suffered(split, ends), least * (1.0 - 1e-9)) << "round " << round;
        }
    }
}

TEST(SampledDepths, OnesThatSayNothingAreNotUsed) {
    CascadeSplitDistances ends{};
    const ConsumerItem here = counting_camera();
    ConsumerItem other = here, nobody = here;
    other.entity = kOther;
    nobody.entity = ecs::kNull;
    const SampledDepths depths = pixels_at({8.0}), none, sky{.camera = kCamera};
    EXPECT_TRUE(sampled_splits({depths, here, 4, kWhole, kInfinity}, ends));
    EXPECT_FALSE(sampled_splits({depths, other, 4, kWhole, kInfinity}, ends));
    EXPECT_FALSE(sampled_splits({none, here, 4, kWhole, kInfinity}, ends));
    EXPECT_FALSE(sampled_splits({none, nobody, 4, kWhole, kInfinity}, ends))
        << "no camera's pixels are not those of none";
    EXPECT_FALSE(sampled_splits({sky, here, 4, kWhole, kInfinity}, ends));
    EXPECT_FALSE(sampled_splits({depths, here, 4, {10.0, 20.0}, kInfinity}, ends)) << "no pixel lies where receivers do";
    EXPECT_FALSE(sampled_splits({depths, here, 4, {1.0, kInfinity}, kInfinity}, ends));
}

TEST(SampledDepths, HeldEndsStayUntilOthersAreATenthBetter) {
    const ConsumerItem here = counting_camera();
    SampledSplitHistory previous, next;
    CascadeSplitDistances first{}, second{};
    const auto fit = [&](const SampledDepths& depths, CascadeSplitDistances& ends) {
        previous = next;
        EXPECT_TRUE(held_sampled_splits({depths, here, 4, kWhole, kInfinity}, previous, next, ends));
    };
    fit(pixels_at({1.0, 4.0, 16.0}), first);
    EXPECT_EQ(first, ends_of(pixels_at({1.0, 4.0, 16.0}), 4)) << "nothing is previous yet";
    SampledDepths flicker = pixels_at({1.0, 4.0, 16.0});
    flicker.pixels[bin_at(4.0) + 1] = 100;
    EXPECT_NE(ends_of(flicker, 4), first) << "pixels in the next bin would move an end";
    fit(flicker, second);
    EXPECT_EQ(second, first);
    fit(pixels_at({3.0, 30.0, 300.0}), second);
    EXPECT_EQ(second, ends_of(pixels_at({3.0, 30.0, 300.0}), 4));
}

TEST(SampledDepths, AbsurdHeldEndsNeitherFallNorLeaveTheWhole) {
    const ConsumerItem here = counting_camera();
    const SampledDepths depths = pixels_at({1.0, 4.0, 16.0});
        for (const CascadeSplitDistances& absurd : {CascadeSplitDistances{9.0, 8.0, 7.0, 6.0}, CascadeSplitDistances{kNan, kNan, kNan, kNan},
                                      CascadeSplitDistances{-5.0, 1e300, -1e300, 0.0}}) {
        SampledSplitHistory next;
        CascadeSplitDistances ends{};
        ASSERT_TRUE(held_sampled_splits({depths, here, 3, kWhole, kInfinity}, {3, absurd}, next, ends));
        EXPECT_EQ(ends[0], kWhole.lowest);
        EXPECT_EQ(ends[3], kWhole.highest);
        for (std::uint32_t i = 0; i < 3; ++i) EXPECT_LE(ends[i], ends[i + 1]);
    }
}

SceneSnapshot two_suns() {
    SceneSnapshot scene;
    scene.lights.resize(2);
    for (LightItem& light : scene.lights) light.kind = LightKind::directional;
    return scene;
}

/// Two suns' fits, each of `cascades` cascades.
struct TwoFits {
    explicit TwoFits(std::uint32_t cascades) : fitted{std::vector<FitChoice>(2), {}, {}, {}, {}}, statuses(2) {
        for (FitChoice& light : fitted.lights) light.request.map.view_count = cascades;
    }
    bool want(const SceneSnapshot& scene) const { return wants_sampled_depths(scene, fitted, statuses); }
    FittedViews fitted;
    std::vector<LightStatus> statuses;
};

TEST(SampledDepths, AreWantedByASunWithCascadesThatAsksForThem) {
    SceneSnapshot scene = two_suns();
    EXPECT_FALSE(TwoFits(4).want(scene));
    scene.lights[1].tuning.cascades.splits = CascadeSplits::sampled;
    EXPECT_TRUE(TwoFits(4).want(scene));
    EXPECT_FALSE(TwoFits(1).want(scene)) << "one cascade has no end to choose";
    TwoFits unseen(4), eye(4);
    unseen.statuses[1].skip(Reason::no_visible_receiver);
    EXPECT_FALSE(unseen.want(scene));
    eye.fitted.lights[1].request.projection.perspective_sun = true;
    EXPECT_FALSE(eye.want(scene));
    scene.lights[1].kind = LightKind::spot;
    EXPECT_FALSE(TwoFits(4).want(scene));
}

TEST(SampledDepths, AreNotWantedWhereSplitsFallBackToTheDefault) {
    SceneSnapshot scene = two_suns();
    scene.lights[0].tuning.cascades.splits = CascadeSplits::sampled;
    scene.lights[0].tuning.cascades.split_lambda = -1.0f;
    EXPECT_FALSE(TwoFits(4).want(scene));
}

}  // namespace
}  // namespace gnomon::shadow
