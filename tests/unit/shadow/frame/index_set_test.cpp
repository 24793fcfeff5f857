#include "systems/shadow/frame/index_set.h"

#include <gmock/gmock.h>

#include <random>
#include <set>

#include "tests/unit/math/random_seed.h"

namespace gnomon::shadow {
namespace {

std::vector<std::uint32_t> in(const IndexSet& marks) {
    std::vector<std::uint32_t> found;
    marks.for_each([&](std::uint32_t i) { found.push_back(i); });
    return found;
}

TEST(IndexSet, GiveBackWhatWasAddedOnceAndInOrder) {
    std::mt19937_64 random(print_seed());
    IndexSet marks;
    for (int round = 0; round < 300; ++round) {
        const std::uint32_t count = std::uniform_int_distribution<std::uint32_t>(1, 10000)(random);
        marks.clear(count);
        std::set<std::uint32_t> added;
        const int adds = round % 3 == 0 ? 3 : 200;
        for (int k = 0; k < adds; ++k) {
            const std::uint32_t i = std::uniform_int_distribution<std::uint32_t>(0, count - 1)(random);
            marks.add(i);
            added.insert(i);
        }
        ASSERT_THAT(in(marks), ::testing::ElementsAreArray(added)) << count;
    }
}

TEST(IndexSet, AreGoneOnceClearedWhateverTheNewCount) {
    IndexSet marks;
    EXPECT_THAT(in(marks), ::testing::IsEmpty());
    for (const std::size_t count : {5000u, 4096u, 64u, 1u, 0u, 100000u, 4097u}) {
        marks.clear(count);
        EXPECT_THAT(in(marks), ::testing::IsEmpty()) << count;
        if (count > 0) marks.add(static_cast<std::uint32_t>(count) - 1);
    }
}

}  // namespace
}  // namespace gnomon::shadow
