#include "bench/accuracy/surface_mismatch.h"

#include <gmock/gmock.h>

namespace gnomon::bench {
namespace {

using ::testing::ElementsAre;

TEST(OtherSurfaces, AreLeftOutWhereTheyWouldBeCountedAndNowhereElse) {
    oracle::LightTruth truth;
    truth.scored = {1, 1, 1, 0};
    truth.ambiguous = {0, 1, 0, 0};
    EXPECT_EQ(leave_out({1, 1, 0, 1}, truth), 1u) << "the second is left out anyway, the last is not scored";
    EXPECT_THAT(truth.ambiguous, ElementsAre(1, 1, 0, 0));
    EXPECT_THAT(truth.scored, ElementsAre(1, 1, 1, 0)) << "edges run between all of them";
    EXPECT_EQ(leave_out({1, 1, 0, 1}, truth), 0u);
}

}  // namespace
}  // namespace gnomon::bench
