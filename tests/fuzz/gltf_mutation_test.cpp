// The structure-aware fuzzer's inputs from a fixed random sequence, so that every compiler runs some of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <string>

#include "engine/assets/gltf_loader.h"
#include "tests/fuzz/gltf_mutator.h"

namespace gnomon::test {
namespace {

constexpr int kExecutions = 20'000;
#ifdef GNOMON_SANITIZED
constexpr int kCounted = kExecutions / 4;  // which rules are reached is no sanitizer's business, and takes it minutes
#else
constexpr int kCounted = kExecutions;
#endif
constexpr std::size_t kMostChoices = 40;

std::vector<std::uint8_t> random_choices(std::mt19937_64& random) {
    std::vector<std::uint8_t> choices(1 + random() % kMostChoices);
    for (std::uint8_t& choice : choices) choice = static_cast<std::uint8_t>(random());
    return choices;
}

int executions() {
    const char* wanted = std::getenv("GNOMON_FUZZ_EXECUTIONS");
    return wanted != nullptr ? std::atoi(wanted) : kExecutions;
}

TEST(GltfMutation, NeverBreaksAPromiseOfTheLoader) {
    const char* seed = std::getenv("GNOMON_FUZZ_SEED");
    std::mt19937_64 random(seed != nullptr ? std::strtoull(seed, nullptr, 10) : 1);
    for (int i = 0; i < executions(); ++i) load_and_check(mutated_gltf(random_choices(random)));
}

TEST(GltfMutation, ReachesManyRulesAndManyGoodScenes) {
    std::mt19937_64 random(2);
    std::map<std::string, int> verdicts;
    std::set<std::string> unplaced;  // what the library behind the door complained of: that names no place
    for (int i = 0; i < kCounted; ++i) {
        const auto result = assets::load_gltf_memory(mutated_gltf(random_choices(random)), {}, "fuzz.gltf");
        ++verdicts[result ? "ok" : result.error().rule];
        if (!result && result.error().rule == "gltf.parse") unplaced.insert(result.error().message);
    }
    EXPECT_GE(verdicts["ok"], kCounted / 20);
    EXPECT_GE(verdicts.size(), 30U) << "a fuzzer that trips on the same few rules is blind behind them";
    EXPECT_THAT(unplaced, testing::IsEmpty());
    for (const auto& [rule, count] : verdicts) RecordProperty("rule." + rule, count);
}

TEST(GltfMutation, GivesTheSameFileForTheSameChoices) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 100; ++i) {
        const auto choices = random_choices(random);
        EXPECT_EQ(mutated_gltf(choices), mutated_gltf(choices));
    }
}

}  // namespace
}  // namespace gnomon::test
