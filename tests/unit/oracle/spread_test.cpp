#include "bench/common/median_range.h"

#include <gtest/gtest.h>

namespace gnomon::bench {
namespace {

TEST(Spread, NothingMeasuredIsCountZero) { EXPECT_EQ(spread_of({}).count, 0u); }

TEST(Spread, TheMedianOfOddAndEvenCountsAndTheEnds) {
    const Spread odd = spread_of({5.0, 1.0, 100.0});
    EXPECT_EQ(odd.median, 5.0);
    EXPECT_EQ(odd.min, 1.0);
    EXPECT_EQ(odd.max, 100.0);
    EXPECT_EQ(odd.count, 3u);
    EXPECT_EQ(spread_of({4.0, 1.0, 2.0, 100.0}).median, 3.0);
}

}  // namespace
}  // namespace gnomon::bench
