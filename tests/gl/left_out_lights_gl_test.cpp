#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "bench/accuracy/reference_images.h"
#include "bench/compare/evaluate_configuration.h"
#include "sample_game/support/built_in_scenes/glb_writer.h"
#include "sample_game/support/built_in_scenes/look_rotation.h"
#include "tests/gl/truth_scenes.h"

/// Lights with shadows that are left out on purpose, because they would be invisible. The bench names the lights and
/// counts nothing.
namespace gnomon {
namespace {

using Json = nlohmann::json;

class LeftOutLights : public TruthTest {
protected:
    /// Returns a ground and a box beneath a bright sun, a candle beside it and a lamp that is off.
    static std::vector<std::byte> box_by_candle() {
        game::GlbBuilder glb;
        const std::uint32_t matt = glb.add_material({.name = "matt"});
        const auto add_light = [&](const char* name, const char* type, double intensity, const glm::dvec3& at_m) {
            const std::uint32_t light = glb.add_light({.type = type, .intensity = intensity});
            glb.add_node({.name = name, .translation_m = at_m, .rotation = game::facing(-at_m), .light = light});
        };
        glb.add_node(
            {.name = "ground", .mesh = glb.add_mesh("ground", game::make_box({-4, -0.5, -4}, {4, 0, 4}), matt)});
        glb.add_node(
            {.name = "box", .mesh = glb.add_mesh("box", game::make_box({-0.5, 0, -0.5}, {0.5, 1, 0.5}), matt)});
        add_light("sun", "directional", 50000.0, {-3.0, 4.0, -2.0});
        add_light("candle", "point", 1.0, {-2.0, 2.0, 1.0});
        add_light("off", "point", 0.0, {-2.0, 2.0, -1.0});
        const std::uint32_t camera = glb.add_camera({.name = "main", .fov_y_rad = 0.8, .near_m = 0.05});
        const glm::dvec3 eye_m(3.6, 3.2, 5.2);
        glb.add_node({.name = "main", .translation_m = eye_m, .rotation = game::facing(-eye_m), .camera = camera});
        return glb.finish({.name = "scene"});
    }
    std::unique_ptr<bench::Stage> open_scene() {
        const auto file = own_.path() / "candle.glb";
        EXPECT_FALSE(game::write_file(file, box_by_candle()));
        bench::StageOptions options;
        options.scene = file;
        options.size_px = {160, 90};
        return open(options);
    }
    static Json json_of(const bench::Accuracy& accuracy, const std::string& name) {
        const Json lights = Json::parse(bench::accuracy_json(accuracy))["lights"];
        for (const Json& light : lights)
            if (light["name"] == name) return light;
        ADD_FAILURE() << name;
        return {};
    }

private:
    OwnFolder own_;
};

constexpr double kSome = 0.02;  // least share of the pixels that the box darkens for each light

TEST_F(LeftOutLights, AreNamedInTheTableAndHaveNoShareOfWrongPixels) {
    const auto stage = open_scene();
    ASSERT_TRUE(stage);
    const bench::Accuracy accuracy = measure(*stage);
    ASSERT_EQ(accuracy.lights.size(), 3u);
    const std::string table = bench::accuracy_table(accuracy);
    for (const auto& [name, reason] : {std::pair("candle", "below_display_step"), std::pair("off", "light_off")}) {
        const Json light = json_of(accuracy, name);
        EXPECT_EQ(light["left_out"], true) << name;
        EXPECT_EQ(light["reason"], reason);
        for (const char* counted : {"scored_px", "wrong_px", "wrong", "acne", "leak", "edge", "edge_exceptions"})
            EXPECT_TRUE(light[counted].is_null()) << name << ", " << counted;
        EXPECT_THAT(table, ::testing::ContainsRegex(std::string(name) + " +left out.*" + reason));
        EXPECT_THAT(table, ::testing::Not(::testing::HasSubstr(std::string(name) + ": above")));
        EXPECT_EQ(find_light(accuracy, name)->metrics.scored, 0u) << "sums over lights count it as well";
    }
    const Json sun = json_of(accuracy, "sun");
    EXPECT_EQ(sun["left_out"], false);
    EXPECT_GT(sun["scored_px"], 1000);
}

/// Checks that shadows of the same lights count if they are missing for another reason (negative control).
TEST_F(LeftOutLights, AreCountedIfTheirShadowsAreMissingForAnotherReason) {
    const auto stage = open_scene();
    ASSERT_TRUE(stage);
    stage->show_shadows(false);
    const bench::Accuracy accuracy = measure(*stage);
    for (const char* name : {"sun", "candle"}) {
        const Json light = json_of(accuracy, name);
        EXPECT_EQ(light["left_out"], false) << name;
        EXPECT_EQ(light["reason"], "shadows_off") << name;
        EXPECT_GT(light["wrong"], kSome) << name;
        EXPECT_GT(light["leak_px"], 0) << name;
    }
}

TEST_F(LeftOutLights, HaveNoErrorsInASweepAndKeepTheirReason) {
    const auto stage = open_scene();
    ASSERT_TRUE(stage);
    const auto truths = bench::trace_truths(*stage);
    ASSERT_TRUE(truths);
    const bench::JudgedRow row =
        bench::judge_row(*stage, truths.value(), {.name = "defaults", .settings = {}}, {.edges = true});
    ASSERT_FALSE(row.error) << *row.error;
    ASSERT_EQ(row.lights.size(), 3u);
    for (const bench::LightRow& light : row.lights) {
        const bool left_out = light.light != "sun";
        EXPECT_EQ(light.figures.wrong.has_value(), !left_out) << light.light;
        EXPECT_EQ(light.figures.scored_px.has_value(), !left_out) << light.light;
        EXPECT_EQ(light.figures.leak.has_value(), !left_out) << light.light;
        if (!left_out) continue;
        EXPECT_THAT(light.reason, ::testing::AnyOf("light_off", "below_display_step")) << light.light;
    }
}

}  // namespace
}  // namespace gnomon
