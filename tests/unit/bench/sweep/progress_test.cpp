#include <gtest/gtest.h>

#include "bench/sweep/progress.h"

namespace gnomon::bench {
namespace {

constexpr double kBudget_s = 1080.0;

TEST(SweepTimeLeft, OfRoundsIsWhatThoseBeforeTook) {
    EXPECT_EQ(time_left({.spent_s = 20.0, .timed_s = 5.0, .rounds_timed = 1}, 3, kBudget_s), "about 10 s left");
    EXPECT_EQ(time_left({.spent_s = 30.0, .timed_s = 15.0, .rounds_timed = 3}, 3, kBudget_s), "about 0 s left");
    EXPECT_EQ(time_left({.spent_s = 500.0, .timed_s = 360.0, .rounds_timed = 2}, 4, kBudget_s), "about 6 min left");
    EXPECT_EQ(time_left({.spent_s = 60.0, .timed_s = 10.0, .rounds_timed = 0.25}, 2, kBudget_s), "about 2 min left");
}

TEST(SweepTimeLeft, IsBoundedByTheBudgetWhileNoRoundHasBeenTimed) {
    EXPECT_EQ(time_left({.judging_left_s = 30.0, .spent_s = 60.0}, 5, kBudget_s), "at most 17 min left");
    EXPECT_EQ(time_left({.spent_s = 500.0, .timed_s = 400.0, .rounds_timed = 1}, 5, kBudget_s), "about 10 min left");
}

TEST(SweepTimeLeft, WithoutRoundsIsTheJudging) {
    EXPECT_EQ(time_left({.judging_left_s = 12.4, .spent_s = 3.0}, 0, kBudget_s), "about 12 s left");
    EXPECT_EQ(time_left({.judging_left_s = 200.0, .spent_s = 2000.0}, 0, kBudget_s), "about 4 min left");
}

TEST(SweepTimeLeft, BeyondTheBudgetIsTheJudgingAtLeast) {
    EXPECT_EQ(time_left({.judging_left_s = 90.0, .spent_s = 1070.0}, 5, kBudget_s), "at most 2 min left");
}

}  // namespace
}  // namespace gnomon::bench
