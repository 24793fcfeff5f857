#include "systems/shadow/update/update_scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/unit/math/random_seed.h"

/// Which views are deferred when more are due than a frame has time for.
namespace gnomon::shadow {
namespace {

std::set<std::size_t> waiting(double room_ns, std::vector<DueView> due) {
    const std::size_t count = choose_waiting(room_ns, due);
    std::set<std::size_t> views;
    for (std::size_t i = 0; i < count; ++i) views.insert(due[i].view);
    return views;
}
double drawn_ns(const std::vector<DueView>& due, const std::set<std::size_t>& waits) {
    double sum_ns = 0.0;
    for (const DueView& view : due) sum_ns += waits.count(view.view) == 0 ? view.ns : 0.0;
    return sum_ns;
}
constexpr double kNever = DueView::kMustNotWait;

TEST(DrawSpread, HasNobodyWaitWhereAllFit) {
    EXPECT_TRUE(waiting(10.0, {}).empty());
    EXPECT_TRUE(waiting(10.0, {{0, 4.0, 0.0, 1}, {1, 6.0, 0.0, 2}}).empty());
}

TEST(DrawSpread, HasThoseWaitThatLoseLeastForWhatTheyFree) {
    EXPECT_EQ(waiting(6.0, {{0, 5.0, 0.5, 1}, {1, 5.0, 0.1, 2}}), std::set<std::size_t>{1});
    EXPECT_EQ(waiting(6.0, {{0, 5.0, 0.1, 1}, {1, 1.0, 0.1, 2}, {2, 5.0, 0.5, 3}}), std::set<std::size_t>{0})
        << "of equal harm the one that frees more";
    // The cheap views free too little. The dear view frees enough, so that deferring the cheap ones is needless.
    EXPECT_EQ(waiting(13.0, {{0, 1.0, 0.01, 1}, {1, 2.0, 0.03, 2}, {2, 9.0, 0.9, 3}, {3, 10.0, kNever, 4}}),
              std::set<std::size_t>{2});
}

TEST(DrawSpread, DrawsOneViewAtLeast) {
    EXPECT_TRUE(waiting(0.0, {{0, 5.0, 0.1, 1}}).empty());
    EXPECT_EQ(waiting(0.0, {{0, 5.0, 0.1, 1}, {1, 4.0, 0.5, 2}}), std::set<std::size_t>{0});
}

TEST(DrawSpread, DrawsWhatMustNotWaitWhateverItTakes) {
    EXPECT_EQ(waiting(1.0, {{0, 5.0, kNever, 1}, {1, 5.0, kNever, 2}, {2, 3.0, 0.9, 3}}), std::set<std::size_t>{2});
    EXPECT_TRUE(waiting(0.0, {{0, 5.0, kNever, 1}}).empty());
}

/// With it sums once hung on the order in which views came.
constexpr std::uint64_t kSumsByOrder = 30;

void keep_to_room(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto number = [&](double most) { return std::uniform_real_distribution(0.0, most)(random); };
    std::size_t waited = 0, drawn = 0;
    for (int round = 0; round < 1000; ++round) {
        std::vector<DueView> due;
        double forced_ns = 0.0, largest_ns = 0.0;
        for (std::size_t i = 0; i < 1 + random() % 30; ++i) {
            const bool forced = random() % 5 == 0;
            due.push_back({i, number(10.0), forced ? kNever : number(1.0), random()});
            if (forced) forced_ns += due.back().ns;
            largest_ns = std::max(largest_ns, due.back().ns);
        }
        const double given_ns = number(80.0), room_ns = std::max(given_ns, largest_ns);
        const std::set<std::size_t> waits = waiting(given_ns, due);
        const double left_ns = drawn_ns(due, waits);
        EXPECT_LE(left_ns, std::max(room_ns, forced_ns) + 1e-9);
        for (const DueView& view : due) {
            if (waits.count(view.view) == 0) continue;
            EXPECT_LT(view.harm, kNever);
            EXPECT_GT(left_ns + view.ns, room_ns - 1e-9) << "there was room for it";
        }
        waited += waits.size();
        drawn += due.size() - waits.size();
        std::shuffle(due.begin(), due.end(), random);
        EXPECT_EQ(waiting(given_ns, due), waits);
    }
    EXPECT_GT(waited, 1000u);
    EXPECT_GT(drawn, 1000u);
}

TEST(DrawSpread, KeepsToItsRoomAndLetsNobodyWaitForNothingInAnyOrder) {
    for (const std::uint64_t seed : {print_seed(), kSumsByOrder}) keep_to_room(seed);
}

}  // namespace
}  // namespace gnomon::shadow
