#include "bench/compare/pareto_front.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon::bench {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(FilterFront, EachCostHasItsLeastError) {
    const std::vector<ErrorAndCost> choices = {{3.0, 1.0}, {2.0, 2.0}, {1.0, 4.0}};
    EXPECT_THAT(on_front(choices), ElementsAre(1, 1, 1));
}

TEST(FilterFront, WhatErrsMoreForMoreIsBeaten) {
    const std::vector<ErrorAndCost> choices = {{3.0, 1.0}, {3.5, 2.0}, {2.0, 2.0}, {2.5, 8.0}};
    EXPECT_THAT(on_front(choices), ElementsAre(1, 0, 1, 0));
}

TEST(FilterFront, CostsWithinTheNoiseAreTheSame) {
    const double within = 1.0 - 0.5 * kCostNoise, beyond = 1.0 - 2.0 * kCostNoise;
    EXPECT_THAT(on_front(std::vector<ErrorAndCost>{{2.0, within}, {1.0, 1.0}}), ElementsAre(0, 1));
    EXPECT_THAT(on_front(std::vector<ErrorAndCost>{{2.0, beyond}, {1.0, 1.0}}), ElementsAre(1, 1));
}

TEST(FilterFront, EqualsStayBothAndTheDearerOfEqualErrorsGoes) {
    EXPECT_THAT(on_front(std::vector<ErrorAndCost>{{1.0, 1.0}, {1.0, 1.0}}), ElementsAre(1, 1));
    EXPECT_THAT(on_front(std::vector<ErrorAndCost>{{1.0, 1.0}, {1.0, 2.0}}), ElementsAre(1, 0));
}

TEST(FilterFront, TheLeastErrorIsNeverBeatenWhateverItCosts) {
    std::vector<ErrorAndCost> choices;
    for (int i = 0; i < 100; ++i) choices.push_back({0.01 * ((i * 37) % 100), 1.0 + (i * 61) % 100});
    choices.push_back({-1.0, 1.0e9});
    EXPECT_EQ(on_front(choices).back(), 1);
}

TEST(FilterFront, WithoutTimesTheLeastErrorAloneRemains) {
    const std::vector<ErrorAndCost> choices = {{2.0, 0.0}, {1.0, 0.0}, {3.0, 0.0}};
    EXPECT_THAT(on_front(choices), ElementsAre(0, 1, 0));
}

TEST(FilterFront, NothingHasNone) { EXPECT_THAT(on_front({}), IsEmpty()); }

}  // namespace
}  // namespace gnomon::bench
