#include "bench/sweep/sweep_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/source_paths.h"

namespace gnomon::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Makes two rows of "sun" with shares of wrong pixels of 0.02 and 0.0005, and a row that failed.
SceneSweep some_sweep() {
    SceneSweep sweep;
    sweep.scene = "a scene";
    sweep.size_px = {320, 180};
    for (const char* name : {"defaults", "fine", "failed"}) {
        SweepRow& planned = sweep.plan.emplace_back();
        planned.name = name;
        planned.settings = {"filter=hard"};
        sweep.rows.push_back({name, std::nullopt, {}});
    }
    for (const double wrong : {0.02, 0.0005}) {
        LightRow light{"sun", LightKind::directional, "rendered", "none", {}};
        light.figures.wrong = wrong;
        sweep.rows[wrong == 0.02 ? 0 : 1].lights.push_back(light);
    }
    sweep.rows[2].error = "no \"room\", sorry";
    return sweep;
}

nlohmann::json read_back(const SceneSweep& sweep) { return nlohmann::json::parse(sweep_json({sweep})); }

TEST(SweepJson, ReadmeNamesEveryKeyAndEveryFigure) {
    std::ifstream file(test::source_folder() / "bench/README.md");
    const std::string readme{std::istreambuf_iterator<char>(file), {}};
    const auto json = read_back(some_sweep());
    const auto& scene = json.at("scenes").at(0);
    for (const auto& part : {json, json.at("columns"), scene, scene.at("rows").at(0), scene["rows"][0]["lights"][0],
                             scene["rows"][0]["lights"][0]["figures"]})
        for (const auto& [key, value] : part.items()) EXPECT_THAT(readme, HasSubstr("`" + key + "`")) << key;
}

TEST(SweepJson, HasNullForWhatWasNotMeasuredAndTheErrorOfARowThatFailed) {
    const auto scene = read_back(some_sweep()).at("scenes").at(0);
    EXPECT_EQ(scene.at("rows").size(), 3u);
    EXPECT_EQ(scene["rows"][2]["error"], "no \"room\", sorry");
    EXPECT_TRUE(scene["rows"][0]["error"].is_null());
    const auto& figures = scene["rows"][1]["lights"][0]["figures"];
    EXPECT_EQ(figures.at("wrong"), 0.0005);
    EXPECT_TRUE(figures.at("kept_ratio").is_null());
}

TEST(SweepJson, SaysOfEachLightWhichBoundsItIsAbove) {
    SceneSweep sweep = some_sweep();
    const auto above = [&](std::size_t row) {
        return read_back(sweep)["scenes"][0]["rows"][row]["lights"][0].at("above").get<std::string>();
    };
    EXPECT_THAT(above(0), StartsWith("2 % wrong (0.05 %)"));
    EXPECT_EQ(above(1), "");
    sweep.rows[1].lights[0].figures.leak = 0.00012;
    EXPECT_THAT(above(1), StartsWith("0.012 % leak (0.01 %)"));
    sweep.rows[0].lights[0].figures.wrong = {};  // its filter softens by the source's size
    EXPECT_EQ(above(0), "");
}

}  // namespace
}  // namespace gnomon::bench
