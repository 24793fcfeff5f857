#include "engine/core/workers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/unit/allocation_counter.h"

namespace gnomon {
namespace {

constexpr std::size_t kThreads = 3;

TEST(Workers, DoEachJobOnce) {
    Workers workers(kThreads);
    for (const std::size_t count : std::array<std::size_t, 6>{0, 1, 2, 3, 100, 10'000}) {
        std::vector<std::atomic<int>> done(count);
        workers.run(count, kThreads, [&](std::size_t i, std::size_t) { ++done[i]; });
        EXPECT_TRUE(std::all_of(done.begin(), done.end(), [](const auto& times) { return times == 1; })) << count;
    }
}

/// Keeps each job busy until as many run at once as there are threads.
TEST(Workers, RunAtOnceOnThreadsWithNumbersOfTheirOwn) {
    Workers workers(kThreads);
    for (int round = 0; round < 100; ++round) {
        std::atomic<std::size_t> here = 0;
        std::array<std::atomic<int>, kThreads> jobs_of{};
        std::mutex mutex;
        std::set<std::thread::id> ids;
        workers.run(kThreads, kThreads, [&](std::size_t, std::size_t thread) {
            ASSERT_LT(thread, kThreads);
            ++jobs_of[thread];
            {
                const std::lock_guard lock(mutex);
                ids.insert(std::this_thread::get_id());
            }
            for (++here; here < kThreads;) std::this_thread::yield();
        });
        EXPECT_EQ(ids.size(), kThreads);
        EXPECT_TRUE(ids.contains(std::this_thread::get_id())) << "the calling thread takes part";
        for (const std::atomic<int>& jobs : jobs_of) EXPECT_EQ(jobs, 1);
    }
}

TEST(Workers, UseNoMoreThreadsThanAskedFor) {
    Workers one(1), several(kThreads);
    const std::thread::id caller = std::this_thread::get_id();
    const auto alone = [&](std::size_t, std::size_t thread) {
        EXPECT_EQ(thread, 0u);
        EXPECT_EQ(std::this_thread::get_id(), caller);
    };
    one.run(100, kThreads, alone);
    several.run(100, 1, alone);
    several.run(1, kThreads, alone);
    several.run(1000, 2, [](std::size_t, std::size_t thread) { EXPECT_LT(thread, 2u); });
    several.run(1000, 100, [](std::size_t, std::size_t thread) { EXPECT_LT(thread, kThreads); });
}

TEST(Workers, AreBetweenOneAndAFew) {
    EXPECT_GE(Workers(0).threads(), 1u);
    EXPECT_LE(Workers(0).threads(), Workers::kMost);
    EXPECT_EQ(Workers(1).threads(), 1u);
    EXPECT_EQ(Workers(1000).threads(), Workers::kMost);
}

TEST(Workers, HandAJobsExceptionToTheCallerAndGoOn) {
    for (const std::size_t threads : {std::size_t{1}, kThreads}) {
        Workers workers(threads);
        for (int round = 0; round < 20; ++round) {
            std::atomic<int> begun = 0;
            const auto fails = [&](std::size_t i, std::size_t) {
                ++begun;
                if (i == 5) throw std::runtime_error("the sixth");
            };
            EXPECT_THROW(workers.run(1'000'000, threads, fails), std::runtime_error);
            EXPECT_LT(begun, 1'000'000) << "the rest is left out";
            std::atomic<int> done = 0;
            workers.run(100, threads, [&](std::size_t, std::size_t) { ++done; });
            EXPECT_EQ(done, 100);
        }
    }
}

TEST(Workers, AllocateNothingOnceTheyRun) {
    Workers workers(kThreads);
    std::atomic<int> done = 0;
    const auto count = [&](std::size_t, std::size_t) { ++done; };
    workers.run(100, kThreads, count);
    const std::size_t before = allocation_count();
    for (int round = 0; round < 100; ++round) workers.run(100, kThreads, count);
    EXPECT_EQ(allocation_count(), before);
    EXPECT_EQ(done, 101 * 100);
}

}  // namespace
}  // namespace gnomon
