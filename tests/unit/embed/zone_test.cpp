#define GNOMON_ZONE_HEADER "tests/unit/embed/counted_zones.h"
#include "engine/core/zone.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

void inner() {
    GNOMON_ZONE("inner");
    EXPECT_EQ(counted_zones::open, 2);
}

TEST(Zone, OpensWhatTheHeaderDefinesUntilItsBlockEnds) {
    {
        GNOMON_ZONE("outer");
        inner();
        EXPECT_EQ(counted_zones::open, 1);
    }
    EXPECT_EQ(counted_zones::open, 0);
    EXPECT_EQ(counted_zones::entered, (std::vector<std::string>{"outer", "inner"}));
}

}  // namespace
}  // namespace gnomon
