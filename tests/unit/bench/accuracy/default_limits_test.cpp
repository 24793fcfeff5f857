#include "bench/accuracy/default_limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(DefaultLimits, AreMetUpToTheirBounds) {
    EXPECT_EQ(missed_limits({kMostWrongByDefault, kMostLeakByDefault, 0.0, {}, {}}), "");
    EXPECT_EQ(missed_limits({}), "");
    EXPECT_EQ(missed_limits({kMostWrongByDefault, kMostLeakByDefault, 0.0, 1.0, 1.0}), "");
    EXPECT_NE(missed_limits({kMostWrongByDefault * 1.01, 0.0, 0.0, {}, {}}), "");
    EXPECT_NE(missed_limits({0.0, kMostLeakByDefault * 1.01, 0.0, {}, {}}), "");
    EXPECT_NE(missed_limits({0.0, 0.0, 1.0e-9, {}, {}}), "");
}

TEST(DefaultLimits, NameEachErrorAboveItsBoundAndWhatTexelsExplainOfIt) {
    const JudgedErrors errors{0.001, 0.0004, 0.0002, 0.0001, 0.0003};
    EXPECT_EQ(missed_limits(errors),
              "0.1 % wrong (0.05 %), 60 % of that within half a texel of the map or 2 px of a true edge; "
              "0.04 % leak (0.01 %), 25 % of that within half a texel of the map of a true edge; "
              "0.02 % acne (none), 50 % of that within half a texel of the map of a true edge");
    EXPECT_THAT(missed_limits({0.001, 0.0, 0.0, 0.0, 0.0}), HasSubstr("(0.05 %), all of that within"));
    EXPECT_THAT(missed_limits({0.001, 0.0, 0.0, 0.0, {}}), Not(HasSubstr("within"))) << "half of it was not asked";
}

TEST(DefaultLimits, ExplainNoMoreThanThereIs) {
    // A wrong pixel without leak is not far within 2 px of an edge, so the far share is at most the wrong share.
    // Rounding, in shares read from a file, must not print less than nothing.
    EXPECT_THAT(missed_limits({0.001, 0.0, 0.0, 0.0006, 0.0004000001}), HasSubstr("none of that within"));
}

}  // namespace
}  // namespace gnomon::bench
