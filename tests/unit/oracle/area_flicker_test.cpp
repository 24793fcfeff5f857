#include "tests/oracle/area_flicker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace gnomon::oracle {
namespace {

/// A pixel that a straight edge along its sides crosses, by `step_px` a frame, from dark to lit.
struct Crossing {
    std::vector<std::vector<WatchedTruth>> truth;
    std::vector<std::vector<float>> exact, hard;

    Crossing(float step_px, float start_px) {
        for (float beyond_px = start_px; beyond_px < 1.0f + step_px; beyond_px += step_px) {
            const float lit = std::clamp(beyond_px, 0.0f, 1.0f);
            truth.push_back({{WatchedState::whole, lit}});
            exact.push_back({lit});
            hard.push_back({lit >= 0.5f ? 1.0f : 0.0f});
        }
    }
};

TEST(AreaFlicker, OfYesOrNoBesideAMovingEdgeIsTheClosedForm) {
    // One of 1 / step frames jumps by 1 - step more than the truth, all others stay while the truth moves by a step.
    for (const float step_px : {0.125f, 0.25f, 0.5f}) {
        const Crossing edge(step_px, 0.0f);
        const AreaFlicker flicker = compare_changes(edge.truth, edge.hard);
        EXPECT_EQ(flicker.pairs, static_cast<std::size_t>(1.0f / step_px));
        EXPECT_DOUBLE_EQ(flicker.mean, 2.0 * step_px * (1.0 - step_px));
        EXPECT_DOUBLE_EQ(flicker.p99, 1.0 - step_px);
        EXPECT_DOUBLE_EQ(flicker.truth, step_px);
    }
    // The edge stands in the pixel for one frame, amid it.
    const Crossing fast(1.0f, -0.5f);
    const AreaFlicker flicker = compare_changes(fast.truth, fast.hard);
    EXPECT_EQ(flicker.pairs, 2u);
    EXPECT_DOUBLE_EQ(flicker.mean, 0.5);
}

TEST(AreaFlicker, OfTheExactShareIsNone) {
    for (const float step_px : {0.125f, 0.3f, 0.7f}) {
        const Crossing edge(step_px, -0.2f);
        const AreaFlicker flicker = compare_changes(edge.truth, edge.exact);
        EXPECT_GE(flicker.pairs, 2u);
        EXPECT_EQ(flicker.mean, 0.0);
        EXPECT_GT(flicker.truth, 0.0);
    }
}

TEST(AreaFlicker, AnErrorThatStaysIsNoneAndOneThatGoesIs) {
    const std::vector<std::vector<WatchedTruth>> truth(3, {{WatchedState::whole, 0.5f}});
    EXPECT_EQ(compare_changes(truth, std::vector<std::vector<float>>(3, {0.75f})).mean, 0.0);
    const std::vector<std::vector<float>> goes{{0.75f}, {0.5f}, {0.5f}};
    EXPECT_DOUBLE_EQ(compare_changes(truth, goes).mean, 0.125);
}

TEST(AreaFlicker, APixelThatNoEdgeCrossesCountsByItself) {
    const std::vector<std::vector<WatchedTruth>> truth(2, {{WatchedState::whole, 1.0f}, {WatchedState::whole, 0.0f}});
    const std::vector<std::vector<float>> blinks{{1.0f, 0.0f}, {0.5f, 0.0f}};
    const AreaFlicker flicker = compare_changes(truth, blinks);
    EXPECT_EQ(flicker.pairs, 0u);
    EXPECT_EQ(flicker.mean, 0.0);
    EXPECT_EQ(flicker.uncrossed, 2u);
    EXPECT_DOUBLE_EQ(flicker.uncrossed_mean, 0.25);
}

TEST(AreaFlicker, AnEdgeThatPassesTheWholePixelWithinAFrameIsNoCrossing) {
    const std::vector<std::vector<WatchedTruth>> truth{{{WatchedState::whole, 0.0f}}, {{WatchedState::whole, 1.0f}}};
    const std::vector<std::vector<float>> seen{{0.0f}, {1.0f}};
    const AreaFlicker flicker = compare_changes(truth, seen);
    EXPECT_EQ(flicker.pairs, 0u);
    EXPECT_EQ(flicker.uncrossed, 1u);
    EXPECT_EQ(flicker.uncrossed_mean, 0.0);
}

TEST(AreaFlicker, PairsThatDoNotCountAreCountedByTheirReason) {
    using enum WatchedState;
    const WatchedTruth half{whole, 0.5f};
    const std::vector<std::vector<WatchedTruth>> truth{
        {half, half, half, {partial, 0.5f}, {hidden, 0.0f}},
        {{outside, 0.0f}, half, {unreached, 0.0f}, half, {partial, 0.5f}}};
    const std::vector<std::vector<float>> seen{{1, 1, 1, 1, 1}, {0, 0, 0, 0, 0}};
    const AreaFlicker flicker = compare_changes(truth, seen);
    EXPECT_EQ(flicker.pairs, 1u);
    EXPECT_EQ(flicker.mean, 1.0);
    const std::size_t expected[] = {1, 1, 1, 1};  // outside, hidden, unreached, partial
    EXPECT_TRUE(std::equal(std::begin(expected), std::end(expected), std::begin(flicker.left_out)));
    EXPECT_EQ(std::accumulate(std::begin(flicker.left_out), std::end(flicker.left_out), flicker.pairs), 5u);
}

TEST(AreaFlicker, APictureWithoutASurfaceThereIsAllWrong) {
    const std::vector<std::vector<WatchedTruth>> truth(2, {{WatchedState::whole, 0.5f}});
    EXPECT_EQ(compare_changes(truth, std::vector<std::vector<float>>{{-1.0f}, {-1.0f}}).mean, 1.0);
}

TEST(AreaFlicker, OfOneFrameOrNoneIsNothing) {
    EXPECT_EQ(compare_changes({}, {}).pairs, 0u);
    const Crossing edge(0.5f, 0.0f);
    EXPECT_EQ(compare_changes(std::span(edge.truth).first(1), std::span(edge.hard).first(1)).pairs, 0u);
}

}  // namespace
}  // namespace gnomon::oracle
