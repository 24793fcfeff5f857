// One crafted file per rule of the door: each must end in its named error, at the named place, in one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "engine/assets/gltf_limits.h"
#include "tests/source_paths.h"
#include "tests/unit/assets/bad_input.h"

namespace gnomon::test {
namespace {

namespace limits = assets::gltf;

class BadInputs : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputs, EndInTheirNamedErrorInOneLine) {
    const BadInput& input = GetParam();
    const Result<assets::SceneData> result = load(input.make(), input.file);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().rule, input.rule) << to_line(result.error());
    EXPECT_EQ(result.error().pointer, input.pointer) << to_line(result.error());
    EXPECT_EQ(result.error().file, input.file);
    EXPECT_FALSE(result.error().message.empty());
    EXPECT_EQ(to_line(result.error()).find('\n'), std::string::npos);
}

std::string name_of(const testing::TestParamInfo<BadInput>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Crafted, BadInputs, testing::ValuesIn(all_bad_inputs()), name_of);

TEST(BadInputControl, TheUnspoiltTriangleLoads) {
    EXPECT_TRUE(load(triangle().gltf()));
    EXPECT_TRUE(load(triangle().glb(), "good.glb"));
    const Result<assets::SceneData> deepest = load(nodes(chain(limits::kMaxNodeDepth))());
    EXPECT_TRUE(deepest) << to_line(deepest.error());
    EXPECT_TRUE(load(positions({0, 0, 0, 1e6F, 0, 0, 0, 1, 0})()));
    EXPECT_TRUE(load(sparse({1, 2}, [](json&) {})()));
    const auto zeros = load(spoilt([](json& d) {
        d["accessors"][0].erase("bufferView");
        d["accessors"][0]["count"] = limits::kMaxUnbackedElements;
    })());
    EXPECT_TRUE(zeros) << to_line(zeros.error());
}

/// Returns every "word.word" in the text: in the loader's sources these are its rules.
std::set<std::string> rules_in(const std::filesystem::path& file) {
    std::ifstream stream(file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto is_word = [](std::string_view part) {
        return !part.empty() && part.front() >= 'a' && part.front() <= 'z' &&
               part.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string_view::npos;
    };
    std::set<std::string> rules;
    for (std::size_t quote = text.find('"'); quote != std::string::npos; quote = text.find('"', quote + 1)) {
        const std::size_t end = std::min(text.find('"', quote + 1), text.size());
        const std::string_view between = std::string_view(text).substr(quote + 1, end - quote - 1);
        const std::size_t dot = between.find('.');
        if (dot == std::string_view::npos) continue;
        if (is_word(between.substr(0, dot)) && is_word(between.substr(dot + 1))) rules.emplace(between);
    }
    return rules;
}

TEST(BadInputTable, HoldsEveryRuleOfTheLoaderAndNoOther) {
    const std::filesystem::path root = test::source_folder();
    std::set<std::string> rules;
    for (const auto& entry : std::filesystem::directory_iterator(root / "engine/assets"))
        if (entry.path().extension() == ".cpp") rules.merge(rules_in(entry.path()));
    // The rule for what tinygltf or a library finds and the checks before it did not. No known input gets there; a
    // fuzzer looks for one (GltfMutation).
    EXPECT_EQ(rules.erase("gltf.parse"), 1U);
    std::set<std::string> tried = rules_in(root / "tests/unit/assets/bad_uri_test.cpp");
    tried.merge(rules_in(root / "tests/unit/assets/taken_input_test.cpp"));
    tried.merge(rules_in(root / "tests/unit/assets/bad_resource_test.cpp"));
    std::erase_if(tried, [](const std::string& word) {
        return word.ends_with(".bin") || word.ends_with(".gltf") || word.ends_with(".glb");
    });
    for (const BadInput& input : all_bad_inputs()) tried.insert(input.rule);
    EXPECT_THAT(tried, testing::ContainerEq(rules));
    EXPECT_GE(all_bad_inputs().size(), 60U);
    EXPECT_GE(rules.size(), 60U);
}

}  // namespace
}  // namespace gnomon::test
