#include "engine/core/place_moves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "tests/unit/math/random_seed.h"

namespace gnomon {
namespace {

using Places = std::vector<std::uint32_t>;

/// Splices by lists made again.
std::vector<int> expected(const std::vector<int>& values, const Places& removed, const Places& added, int value) {
    std::vector<int> kept;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::binary_search(removed.begin(), removed.end(), i)) kept.push_back(values[i]);
    for (const std::uint32_t at : added) kept.insert(kept.begin() + at, value);
    return kept;
}

std::vector<int> spliced(std::vector<int> values, const Places& removed, const Places& added, int value,
                         std::vector<PlaceMove>& moves) {
    list_moves(static_cast<std::uint32_t>(values.size()), removed, added, moves);
    apply_moves(moves, values.size() - removed.size() + added.size(), values);
    for (const std::uint32_t at : added) values[at] = value;
    return values;
}

/// Draws rising places below `end`.
Places drawn(std::uint32_t end, double share, std::mt19937_64& random) {
    Places places;
    for (std::uint32_t i = 0; i < end; ++i)
        if (std::uniform_real_distribution<double>(0.0, 1.0)(random) < share) places.push_back(i);
    return places;
}

TEST(PlaceMoves, KeepTheOrderOfAllThatStays) {
    std::mt19937_64 random(print_seed());
    const auto below = [&](std::uint32_t most) {
        return std::uniform_int_distribution<std::uint32_t>(0, most)(random);
    };
    std::vector<PlaceMove> moves;
    for (int round = 0; round < 3000; ++round) {
        std::vector<int> values(below(40));
        std::iota(values.begin(), values.end(), 0);
        const Places removed = drawn(static_cast<std::uint32_t>(values.size()), 0.1 * below(10), random);
        const auto kept = static_cast<std::uint32_t>(values.size() - removed.size());
        // Places after a splice have no gaps: below kept values, or at the end.
        Places added = drawn(kept + below(10), 0.1 * below(9), random);
        while (!added.empty() && added.back() >= kept + added.size()) added.pop_back();
        const std::vector<int> wanted = expected(values, removed, added, -1);
        ASSERT_EQ(spliced(values, removed, added, -1, moves), wanted) << "round " << round;
    }
}

TEST(PlaceMoves, AreNoneOutsideOfTheChanges) {
    std::vector<int> values(100);
    std::iota(values.begin(), values.end(), 0);
    std::vector<PlaceMove> moves;
    spliced(values, {40}, {44}, -1, moves);
    ASSERT_EQ(moves.size(), 1u);
    EXPECT_EQ(moves[0].from, 41u);
    EXPECT_EQ(moves[0].to, 40u);
    EXPECT_EQ(moves[0].count, 4u);
    spliced(values, {40}, {40}, -1, moves);
    EXPECT_TRUE(moves.empty()) << "exchanged in place";
    spliced(values, {}, {100}, -1, moves);
    EXPECT_TRUE(moves.empty()) << "put at the end";
    spliced(values, {99}, {}, -1, moves);
    EXPECT_TRUE(moves.empty()) << "taken from the end";
    spliced({}, {}, {0, 1}, -1, moves);
    EXPECT_TRUE(moves.empty());
}

}  // namespace
}  // namespace gnomon
