// The structure-aware fuzzer's inputs from a fixed random sequence, so that every compiler runs some of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <string>

#include "gnomon/assets.h"
#include "tests/fuzz/gltf_mutator.h"
#include "tests/long_run.h"

namespace gnomon::test {
namespace {

constexpr int kExecutions = kSanitized ? 3'000 : 20'000;  // under sanitizers fuzz_gltf_structure runs the same mutator
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

// The rule at the end of a line, as to_line() writes it: "... [rule]". Empty where a warning names none.
std::string rule_of(const std::string& line) {
    const std::size_t begin = line.rfind(" [") + 2;
    const std::size_t end = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz_.", begin);
    return begin >= 2 && end + 1 == line.size() && line.back() == ']' ? line.substr(begin, end - begin) : "";
}

TEST(GltfMutation, NeverBreaksAPromiseOfTheLoader) {
    const char* seed = std::getenv("GNOMON_FUZZ_SEED");
    std::mt19937_64 random(seed != nullptr ? std::strtoull(seed, nullptr, 10) : 1);
    for (int i = 0; i < executions(); ++i) load_and_check(mutated_gltf(random_choices(random)));
}

TEST(GltfMutation, ReachesManyRulesAndManyGoodScenes) {
    std::mt19937_64 random(2);
    std::map<std::string, int> verdicts;  // "ok", and rules by which files were refused, or taken with a warning
    std::set<std::string> unplaced;  // what the library behind the door complained of: that names no place
    for (int i = 0; i < kExecutions; ++i) {
        const auto result = assets::load_gltf_memory(mutated_gltf(random_choices(random)), {}, "fuzz.gltf");
        ++verdicts[result ? "ok" : result.error().rule];
        if (result) {
            for (const std::string& warning : result.value().warnings)
                if (const std::string rule = rule_of(warning); !rule.empty()) ++verdicts[rule];
        }
        if (!result && result.error().rule == "gltf.parse") unplaced.insert(result.error().message);
    }
    EXPECT_GE(verdicts["ok"], kExecutions / 20);
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
