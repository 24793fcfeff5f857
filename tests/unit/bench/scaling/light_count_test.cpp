#include "bench/scaling/light_count.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/scaling/many_lights_scene.h"

namespace gnomon::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::uint64_t kSeed = 7;

std::ptrdiff_t shadowed(const assets::SceneData& scene) {
    return std::count_if(scene.lights.begin(), scene.lights.end(),
                         [](const assets::LightData& light) { return light.casts_shadow; });
}

TEST(DemandScene, HasAsManyLightsAsAskedForAndNoMoreThan200WithShadows) {
    for (const std::uint32_t lights : {0u, 1u, 199u, 200u, 201u, 1000u}) {
        const assets::SceneData scene = demand_scene(lights, kSeed);
        EXPECT_EQ(scene.lights.size(), lights);
        EXPECT_EQ(shadowed(scene), std::min<std::ptrdiff_t>(lights, 200)) << lights;
    }
}

TEST(DemandScene, IsTheSameForTheSameSeedAndAnotherForAnother) {
    const assets::SceneData a = demand_scene(30, kSeed), b = demand_scene(30, kSeed), c = demand_scene(30, kSeed + 1);
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    bool differs = a.nodes.size() != c.nodes.size();
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
        EXPECT_EQ(a.nodes[i].translation_m, b.nodes[i].translation_m) << a.nodes[i].name;
        EXPECT_EQ(a.nodes[i].rotation, b.nodes[i].rotation) << a.nodes[i].name;
        EXPECT_EQ(a.nodes[i].scale, b.nodes[i].scale) << a.nodes[i].name;
        differs = differs || a.nodes[i].translation_m != c.nodes[i].translation_m;
    }
    EXPECT_TRUE(differs);
}

TEST(DemandScene, FewerLightsAreTheFirstOfMore) {
    const assets::SceneData few = demand_scene(10, kSeed), many = demand_scene(1000, kSeed);
    ASSERT_LE(few.nodes.size(), many.nodes.size());
    for (std::size_t i = 0; i < few.nodes.size(); ++i) {
        EXPECT_EQ(few.nodes[i].name, many.nodes[i].name);
        EXPECT_EQ(few.nodes[i].translation_m, many.nodes[i].translation_m);
    }
    for (std::size_t i = 0; i < few.lights.size(); ++i) EXPECT_EQ(few.lights[i].range_m, many.lights[i].range_m);
}

TEST(DemandScene, SpreadsLightsOfAllKindsEvenly) {
    const assets::SceneData scene = demand_scene(1000, kSeed);
    std::array<int, 3> kinds{};
    std::array<int, 4> quarters{};
    for (const assets::LightData& light : scene.lights) ++kinds[static_cast<std::size_t>(light.type)];
    for (const assets::Node& node : scene.nodes)
        if (node.light != assets::kNone)
            ++quarters[(node.translation_m.x < 0.0 ? 0u : 1u) + (node.translation_m.z < 0.0 ? 0u : 2u)];
    EXPECT_EQ(kinds[static_cast<std::size_t>(assets::LightType::directional)], 1);
    EXPECT_EQ(kinds[static_cast<std::size_t>(assets::LightType::point)], 500);
    EXPECT_EQ(kinds[static_cast<std::size_t>(assets::LightType::spot)], 499);
    for (const int count : quarters) EXPECT_NEAR(count, 250, 10);
}

TEST(DemandScene, HasOneMover) {
    const assets::SceneData scene = demand_scene(1, kSeed);
    EXPECT_EQ(std::count_if(scene.nodes.begin(), scene.nodes.end(),
                            [](const assets::Node& node) { return node.name == kDemandMover; }),
              1);
}

Demand made_up() {
    Demand demand;
    demand.device = "a device";
    demand.size_px = {320, 180};
    for (const std::uint32_t lights : {1u, 1000u}) {
        DemandRow row;
        row.lights = lights;
        row.shadowed = std::min(lights, kMostShadowedLights);
        for (auto& modes : row.figures)
            for (DemandFigures& figures : modes)
                figures.frame_us = figures.shadow_cpu_us = {1234.0 * lights, 1000.0 * lights, 2000.0 * lights, 3};
        demand.rows.push_back(row);
    }
    return demand;
}

TEST(DemandOutput, TheTablesHaveALinePerMotionAndNumberOfLights) {
    const std::string text = demand_markdown(made_up());
    EXPECT_THAT(text, HasSubstr("a device"));
    EXPECT_THAT(text, HasSubstr("| 1.23 (1.00–2.00) |"));
    for (const DemandMotion motion : kDemandMotions) EXPECT_THAT(text, HasSubstr(to_text(motion)));
    std::size_t lines = 0;
    for (std::size_t at = text.find("| 1000 | 200 |"); at != std::string::npos;
         at = text.find("| 1000 | 200 |", at + 1))
        ++lines;
    EXPECT_EQ(lines, kDemandMotions.size());
}

TEST(DemandOutput, JsonHasAnEntryPerMotionModeAndNumberOfLights) {
    const auto json = nlohmann::json::parse(demand_json(made_up()));
    EXPECT_EQ(json["rows"].size(), 2 * kDemandMotions.size() * kDemandModes.size());
    EXPECT_EQ(json["rows"].back()["mode"], "economy off");
    EXPECT_EQ(json["rows"].back()["frame_us"]["median"], 1234.0 * 1000);
}

TEST(DemandOutput, ThePlotStaysFiniteWhereNothingIsDrawnAndForOneNumberOfLights) {
    Demand demand = made_up();  // no draws and no bytes: 0 on a logarithmic axis
    EXPECT_THAT(demand_plot(demand), Not(HasSubstr("nan")));
    EXPECT_THAT(demand_plot(demand), Not(HasSubstr("inf")));
    demand.rows.resize(1);
    EXPECT_THAT(demand_plot(demand), Not(HasSubstr("nan")));
    demand.rows.clear();
    EXPECT_THAT(demand_plot(demand), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace gnomon::bench
