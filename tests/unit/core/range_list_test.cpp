#include "engine/core/range_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/unit/math/random_seed.h"

namespace gnomon {
namespace {

TEST(RangeList, TakesTheLowestPlacesThatFit) {
    RangeList list;
    EXPECT_EQ(list.take(1), RangeList::kNone) << "no places yet";
    list.resize(10);
    EXPECT_EQ(list.take(4), 0u);
    EXPECT_EQ(list.take(3), 4u);
    EXPECT_EQ(list.end(), 7u);
    list.give(0, 4);
    EXPECT_EQ(list.take(2), 0u);
    EXPECT_EQ(list.take(3), 7u) << "two of the first four are left";
    EXPECT_EQ(list.take(3), RangeList::kNone);
    EXPECT_EQ(list.take(2), 2u);
    EXPECT_EQ(list.used(), 10u);
}

TEST(RangeList, ResizesOnlyBehindWhatIsInUse) {
    RangeList list;
    list.resize(4);
    EXPECT_EQ(list.take(4), 0u);
    list.resize(8);
    EXPECT_EQ(list.end(), 4u);
    EXPECT_EQ(list.take(4), 4u);
    list.give(4, 4);
    list.resize(4);
    EXPECT_EQ(list.places(), 4u);
    EXPECT_EQ(list.take(1), RangeList::kNone);
}

TEST(RangeList, NeverHandsAPlaceOutTwiceAndLosesNone) {
    std::mt19937_64 random(print_seed());
    const auto number = [&](std::uint32_t most) { return std::uniform_int_distribution<std::uint32_t>(0, most)(random); };
    struct Taken {
        std::uint32_t first, count;
    };
    RangeList list;
    std::vector<Taken> taken;
    std::vector<bool> used;
    for (int step = 0; step < 5000; ++step) {
        if (number(2) > 0) {
            const std::uint32_t count = number(9);
            const std::uint32_t first = list.take(count);
            std::uint32_t lowest = RangeList::kNone, run = 0;
            for (std::uint32_t at = 0; at < used.size() && lowest == RangeList::kNone; ++at) {
                run = used[at] ? 0 : run + 1;
                if (run == count) lowest = at + 1 - count;
            }
            if (count > 0) { ASSERT_EQ(first, lowest); }
            if (first == RangeList::kNone) {
                used.resize(used.size() + number(30), false);
                list.resize(static_cast<std::uint32_t>(used.size()));
                continue;
            }
            std::fill_n(used.begin() + first, count, true);
            taken.push_back({first, count});
        } else if (!taken.empty()) {
            std::swap(taken[number(static_cast<std::uint32_t>(taken.size() - 1))], taken.back());
            list.give(taken.back().first, taken.back().count);
            std::fill_n(used.begin() + taken.back().first, taken.back().count, false);
            taken.pop_back();
        }
        const auto last = std::find(used.rbegin(), used.rend(), true);
        ASSERT_EQ(list.end(), static_cast<std::uint32_t>(used.rend() - last));
        ASSERT_EQ(list.used(), static_cast<std::uint32_t>(std::count(used.begin(), used.end(), true)));
        if (number(50) == 0) {
            used.resize(list.end());
            list.resize(list.end());
        }
    }
}

}  // namespace
}  // namespace gnomon
