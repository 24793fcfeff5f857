#include "systems/shadow/projection/cascade_splits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "systems/extract/volumes.h"
#include "systems/shadow/fitting/directional/slice_sphere.h"
#include "tests/unit/math/random_seed.h"
#include "tests/unit/not_finite.h"

namespace gnomon::shadow {
namespace {

CascadeSplitDistances ends_of(const ShadowTuning::Cascades& tuning, std::uint32_t count, DepthSpan whole,
                    std::vector<DepthSpan> receivers = {}, bool perspective = true) {
    return cascade_split_distances(tuning, count, whole, perspective, receivers);
}

LightItem sun_of(const LightShadow& shadow, const ShadowTuning::Cascades& cascades = {}) {
    LightItem sun;
    sun.shadow = shadow;
    sun.tuning.cascades = cascades;
    return sun;
}

TEST(Splits, UniformOnesAreEquallyLong) {
    const CascadeSplitDistances ends = ends_of({.splits = CascadeSplits::uniform}, 4, {2.0, 10.0});
    for (int i = 0; i <= 4; ++i) EXPECT_DOUBLE_EQ(ends[i], 2.0 + 2.0 * i);
}

TEST(Splits, LogarithmicOnesHaveEqualRatios) {
    const CascadeSplitDistances ends = ends_of({.splits = CascadeSplits::logarithmic}, 3, {1.0, 64.0});
    for (int i = 0; i <= 3; ++i) EXPECT_NEAR(ends[i], std::pow(4.0, i), 1e-12 * ends[i]);
}

TEST(Splits, LambdaGoesFromUniformToLogarithmic) {
    const DepthSpan whole{1.0, 100.0};
    const CascadeSplitDistances uniform = ends_of({.splits = CascadeSplits::uniform}, 4, whole);
    const CascadeSplitDistances logarithmic = ends_of({.splits = CascadeSplits::logarithmic}, 4, whole);
    EXPECT_EQ(ends_of({.split_lambda = 0.0f}, 4, whole), uniform);
    EXPECT_EQ(ends_of({.split_lambda = 1.0f}, 4, whole), logarithmic);
    const CascadeSplitDistances half = ends_of({.split_lambda = 0.5f}, 4, whole);
    for (int i = 1; i < 4; ++i) EXPECT_NEAR(half[i], 0.5 * (uniform[i] + logarithmic[i]), 1e-12);
}

TEST(Splits, AFlatViewKnowsNoLogarithm) {
    const DepthSpan whole{1.0, 100.0};
    const CascadeSplitDistances uniform = ends_of({.splits = CascadeSplits::uniform}, 4, whole);
    for (const auto splits : {CascadeSplits::practical, CascadeSplits::logarithmic})
        EXPECT_EQ(ends_of({.splits = splits}, 4, whole, {}, false), uniform);
}

TEST(Splits, ManualOnesAreTakenAndBoundedByWhatIsSeen) {
    const ShadowTuning::Cascades tuning{.splits = CascadeSplits::manual, .split_m = {5.0f, 15.0f, 400.0f}};
    EXPECT_EQ(cascade_count(sun_of({}, tuning), 2), 4u);
    const CascadeSplitDistances ends = ends_of(tuning, 4, {1.0, 100.0});
    EXPECT_EQ(ends[1], 5.0);
    EXPECT_EQ(ends[2], 15.0);
    EXPECT_EQ(ends[3], 100.0);
    EXPECT_EQ(ends[4], 100.0);
}

TEST(Splits, SeenOnesSpendNothingOnAGap) {
    // Things from 1 to 4 m, then nothing, then from 100 to 400 m: equal logarithms, so two cascades each.
    const CascadeSplitDistances ends = ends_of({.splits = CascadeSplits::seen, .split_lambda = 1.0f}, 4, {1.0, 400.0},
                                     {{100.0, 200.0}, {1.0, 3.0}, {150.0, 400.0}, {2.0, 4.0}});
    EXPECT_NEAR(ends[1], 2.0, 1e-9);
    EXPECT_NEAR(ends[2], 4.0, 1e-9);
    EXPECT_NEAR(ends[3], 200.0, 1e-6);
    const CascadeSplitDistances blind = ends_of({.splits = CascadeSplits::logarithmic}, 4, {1.0, 400.0});
    EXPECT_GT(blind[2], 10.0) << "which the others do";
}

TEST(Splits, OneThatIsSeenEverywhereChangesNothing) {
    const DepthSpan whole{1.0, 100.0};
    const CascadeSplitDistances practical = ends_of({}, 4, whole);
    const CascadeSplitDistances seen = ends_of({.splits = CascadeSplits::seen}, 4, whole, {{-5.0, 60.0}, {20.0, 1000.0}});
    for (int i = 0; i <= 4; ++i) EXPECT_NEAR(seen[i], practical[i], 1e-9 * practical[i]);
}

TEST(Splits, AbsurdWishesAreNotTaken) {
    EXPECT_TRUE(are_splits({}));
    for (const float bad : {-0.1f, 1.1f, kFloatNan, kFloatInfinity}) EXPECT_FALSE(are_splits({.split_lambda = bad})) << bad;
    for (const float bad : {-0.1f, 0.6f, kFloatNan}) EXPECT_FALSE(are_splits({.blend = bad})) << bad;
    const auto manual = [](std::array<float, kMaxCascades - 1> distances_m) {
        return are_splits({.splits = CascadeSplits::manual, .split_m = distances_m});
    };
    EXPECT_TRUE(manual({1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f}));
    EXPECT_FALSE(manual({}));
    EXPECT_FALSE(manual({2.0f, 1.0f}));
    EXPECT_FALSE(manual({1.0f, 1.0f}));
    EXPECT_FALSE(manual({-1.0f}));
    EXPECT_FALSE(manual({kFloatNan}));
    EXPECT_FALSE(manual({1.0f, kFloatInfinity}));
    EXPECT_EQ(cascade_count(sun_of({.cascades = 99}), 4), 8u);
    EXPECT_EQ(cascade_count({}, 4), 4u);
}

TEST(Splits, EndsNeverFallAndStartAndEndWithTheWholeWhateverIsAsked) {
    std::mt19937_64 random(print_seed());
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int round = 0; round < 3000; ++round) {
        ShadowTuning::Cascades tuning;
        tuning.splits = static_cast<CascadeSplits>(round % 6);
        tuning.split_lambda = static_cast<float>(number(0.0, 1.0));
        for (std::size_t i = 0; i < 3; ++i) tuning.split_m[i] = static_cast<float>(std::exp(number(-9.0, 9.0)));
        const double low = round % 7 == 0 ? 0.0 : std::exp(number(-20.0, 20.0));
        const DepthSpan whole{low, low + (round % 11 == 0 ? 0.0 : std::exp(number(-20.0, 20.0)))};
        std::vector<DepthSpan> receivers;
        for (int r = 0; r < round % 5; ++r) {
            const double at = number(-1.0, 2.0) * whole.highest;
            receivers.push_back({at, at + number(0.0, 1.0) * whole.highest});
        }
        const std::uint32_t count =
            cascade_count(sun_of({}, tuning), 1 + static_cast<std::uint32_t>(round) % 8);
        const CascadeSplitDistances ends = cascade_split_distances(tuning, count, whole, round % 3 != 0, receivers);
        EXPECT_EQ(ends[0], whole.lowest);
        EXPECT_EQ(ends[count], whole.highest);
        for (std::uint32_t i = 0; i < count; ++i) EXPECT_LE(ends[i], ends[i + 1]) << "round " << round;
    }
}

TEST(SliceSphere, IsTheSmallestAroundTheSlicesCorners) {
    std::mt19937_64 random(print_seed());
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int round = 0; round < 1000; ++round) {
        ConsumerItem consumer;
        consumer.projection = round % 3 == 0 ? CameraProjection::orthographic : CameraProjection::perspective;
        consumer.fov_y_rad = number(0.05, 2.8);
        consumer.viewport_px = {static_cast<std::uint32_t>(number(1.0, 3000.0)),
                                static_cast<std::uint32_t>(number(1.0, 3000.0))};
        const double from_m = std::exp(number(-5.0, 5.0)), to_m = from_m * (1.0 + std::exp(number(-6.0, 6.0)));
        const SliceSphere sphere = slice_sphere(consumer, from_m, to_m);
        const bool flat = consumer.projection == CameraProjection::orthographic;
        const double tangent = flat ? consumer.half_height_m : std::tan(0.5 * consumer.fov_y_rad);
        const double across = tangent * std::hypot(1.0, aspect(consumer));
        // A ball around points of a body of revolution: its centre is on the axis; search there.
        const auto needed = [&](double centre_m) {
            return std::max(std::hypot(from_m - centre_m, flat ? across : across * from_m),
                            std::hypot(to_m - centre_m, flat ? across : across * to_m));
        };
        EXPECT_LE(needed(sphere.centre_m), sphere.radius_m * (1.0 + 1e-12));
        double best = sphere.radius_m;
        for (int k = 0; k <= 2000; ++k) best = std::min(best, needed(from_m + (to_m - from_m) * k / 2000.0));
        EXPECT_GE(best, sphere.radius_m * (1.0 - 1e-6)) << "round " << round;
    }
}

}  // namespace
}  // namespace gnomon::shadow
