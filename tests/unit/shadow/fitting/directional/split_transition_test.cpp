#include "systems/shadow/fitting/directional/split_transition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/math/frustum.h"

namespace gnomon::shadow {
namespace {

constexpr std::uint32_t kCount = 3;
constexpr double kBlend = 0.2;
const CascadeSplitDistances kHere{1.0, 3.0, 8.0, 20.0}, kThere{0.5, 2.0, 12.0, 40.0};

ConsumerItem camera() {
    ConsumerItem c;
    c.fov_y_rad = 0.8;
    c.viewport_px = {640, 360};
    return c;
}

/// Computes how much of what a point at `distance_m` shows is the next cascade's: the shader's share, summed over
/// borders.
double passed(const CascadeSplitDistances& ends_m, double distance_m) {
    double sum = 0.0;
    for (std::uint32_t i = 1; i < kCount; ++i) {
        const double from_m = fade_start(ends_m, i, kBlend);
        sum += std::clamp((distance_m - from_m) / (ends_m[i] - from_m), 0.0, 1.0);
    }
    return sum;
}

SplitHistory held_at(const CascadeSplitDistances& ends_m) {
    SplitHistory previous;
    glide(ends_m, kCount, kBlend, camera(), {}, previous);
    return previous;
}

TEST(SplitTransition, WithoutAPastTheyAreWhereTheyShouldBe) {
    SplitHistory next;
    const SplitTransition ends = glide(kHere, kCount, kBlend, camera(), {}, next);
    EXPECT_EQ(ends.at_m, kHere);
    EXPECT_EQ(ends.from_m, kHere);
    EXPECT_EQ(next.at_m, kHere);
}

TEST(SplitTransition, TheyReachTheOtherPlaceSoSlowlyThatNoPointPassesByMoreThanAnEighthPerFrame) {
    SplitHistory previous = held_at(kHere);
    CascadeSplitDistances last = kHere;
    int frames = 0;
    for (; last != kThere; ++frames) {
        ASSERT_LT(frames, 120) << "two seconds";
        SplitHistory next = previous;
        const SplitTransition ends = glide(kThere, kCount, kBlend, camera(), previous, next);
        for (double d = 0.4; d < 45.0; d += 0.01)
            ASSERT_LE(std::abs(passed(ends.at_m, d) - passed(last, d)), kMostFade) << "frame " << frames << " at " << d;
        for (std::uint32_t i = 0; i <= kCount; ++i) {
            EXPECT_GE(ends.at_m[i], std::min(kHere[i], kThere[i]));
            EXPECT_LE(ends.at_m[i], std::max(kHere[i], kThere[i]));
            EXPECT_TRUE(i == 0 || ends.at_m[i] >= ends.at_m[i - 1]);
        }
        last = ends.at_m;
        previous = next;
    }
    EXPECT_GT(frames, 8) << "they leap";
    SplitHistory next = previous;
    EXPECT_EQ(glide(kThere, kCount, kBlend, camera(), previous, next).from_m, kThere)
        << "maps need no longer hold both";
}

TEST(SplitTransition, ACameraThatCarriesPointsThroughABandLeavesThemLess) {
    const auto variant_of = [](double step_m) {
        ConsumerItem moved = camera();
        moved.position_ws_m += glm::dvec3(0.0, 0.0, -step_m);
        SplitHistory next;
        const SplitTransition ends = glide(kThere, kCount, kBlend, moved, held_at(kHere), next);
        return std::abs(ends.at_m[1] - kHere[1]);
    };
    // The first band is 0.3 m long at the end of the way.
    EXPECT_GT(variant_of(0.0), 0.0);
    EXPECT_LT(variant_of(0.3 * 0.1), 0.6 * variant_of(0.0));
    EXPECT_GT(variant_of(0.3 * 0.5), 0.0) << "or a hasty camera keeps them for ever";
    EXPECT_EQ(variant_of(10.0), 1.0) << "a cut leaves nothing to be seen passing";
    ConsumerItem turned = camera();
    turned.rotation_ws = math::basis_from_back({1.0, 0.0, 0.0});
    SplitHistory next;
    EXPECT_EQ(glide(kThere, kCount, kBlend, turned, held_at(kHere), next).at_m, kThere) << "nor does a turn away";
}

TEST(SplitTransition, WithoutABandWithAnotherCountOrAfterNonsenseTheyLeap) {
    SplitHistory next;
    EXPECT_EQ(glide(kThere, kCount, 0.0, camera(), held_at(kHere), next).at_m, kThere);
    EXPECT_EQ(glide(kThere, kCount - 1, kBlend, camera(), held_at(kHere), next).at_m, kThere);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0}) {
        SplitHistory previous = held_at(kHere);
        previous.at_m[2] = bad;
        EXPECT_EQ(glide(kThere, kCount, kBlend, camera(), previous, next).at_m, kThere) << bad;
    }
}

}  // namespace
}  // namespace gnomon::shadow
