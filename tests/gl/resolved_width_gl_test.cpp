#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "bench/accuracy/stated_accuracy.h"
#include "bench/scaling/many_lights_scene.h"
#include "engine/math/frustum.h"
#include "sample_game/support/built_in_scenes/primitives.h"
#include "tests/gl/truth_scenes.h"

// Stated widths against combs and wires of every width. Shadows are whole from a width on that is within a factor of
// two of the stated one.
namespace gnomon {
namespace {

/// Height of the bars above the ground, and distance of lamps from it, along the light.
constexpr double kHigh_m = 1.0, kLamp_m = 24.0;
constexpr double kLong_m = 0.8, kRoom_m = 0.5;
/// Widths relative to the stated one: 2^(step / 4).
constexpr int kLeastStep = -4, kMostStep = 1;
/// Places that may be off by more than is predicted where a width counts as shown.
constexpr double kMostOff = 0.001;
constexpr std::size_t kLeastPlaces = 100;

/// Bars far apart; bars with gaps as wide; narrow gaps in a wide board.
enum class Pattern { wires, comb, gaps };
constexpr std::array kPatterns{Pattern::wires, Pattern::comb, Pattern::gaps};
constexpr const char* kPatternNames[] = {"wires", "comb", "gaps"};
/// Along the map's rows, between, and along the diagonal of its texels.
constexpr double kAngles_rad[] = {0.0, 0.5, 0.25 * std::numbers::pi};

/// The light shines along -kToLight. The camera looks straight down at the shadow, which lies beside the bars.
const glm::dvec3 kToLight = glm::normalize(glm::dvec3(1.0, 1.0, 0.0));

assets::Node& add_node(assets::SceneData& scene, const glm::dvec3& at_m, const glm::dvec3& back) {
    assets::Node& node = scene.nodes.emplace_back();
    node.translation_m = at_m;
    node.rotation = glm::quat_cast(math::basis_from_back(back));
    return node;
}

assets::Mesh card_mesh(double wide_m, double high_m) {
    const game::Shape shape = game::make_card(glm::dvec3(0.0), {wide_m, 0.0, 0.0}, {0.0, high_m, 0.0});
    assets::Mesh mesh;
    mesh.name = "bar";
    for (std::size_t i = 0; i < shape.positions.size(); ++i)
        mesh.vertices.push_back({shape.positions[i], shape.normals[i], shape.uvs[i]});
    mesh.indices = shape.indices;
    mesh.submeshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    assets::complete(mesh);
    return mesh;
}

void add_lights(assets::SceneData& scene) {
    using assets::LightType;
    for (const LightType type : {LightType::directional, LightType::spot, LightType::point}) {
        assets::LightData& light = scene.lights.emplace_back();
        light.type = type;
        light.name = type == LightType::directional ? "sun" : (type == LightType::spot ? "spot" : "point");
        light.intensity = type == LightType::directional ? 1000.0f : 1.0e6f;
        light.outer_cone_rad = 0.05f;
        add_node(scene, kToLight * kLamp_m, kToLight).light = static_cast<std::int32_t>(scene.lights.size() - 1);
    }
}

/// Makes ground at y = 0, and flat bars across the light with their shadow around the origin. A sun, a spot and a point
/// light share the direction. Bars have no sides, which a sun would graze.
assets::SceneData bars_scene(Pattern pattern, double width_m, double angle_rad) {
    assets::SceneData scene;
    scene.name = "bars";
    scene.materials.emplace_back();
    scene.meshes.push_back(bench::box_mesh("ground", {-kRoom_m, -0.1, -kRoom_m}, {kRoom_m, 0.0, kRoom_m}));
    scene.nodes.emplace_back().mesh = 0;
    const double wide_m = pattern == Pattern::gaps ? 8.0 * width_m : width_m;
    const double pitch_m = pattern == Pattern::comb ? 2.0 * width_m : 9.0 * width_m;
    scene.meshes.push_back(card_mesh(wide_m, kLong_m));
    const glm::dquat turn =
        glm::quat_cast(math::basis_from_back(kToLight)) * glm::angleAxis(angle_rad, glm::dvec3(0.0, 0.0, 1.0));
    const int each_side = std::max(1, static_cast<int>(0.5 * kLong_m / pitch_m));
    for (int i = -each_side; i <= each_side; ++i) {
        assets::Node& bar = scene.nodes.emplace_back();
        bar.rotation = turn;
        bar.translation_m = kToLight * kHigh_m * std::numbers::sqrt2 + turn * glm::dvec3(i * pitch_m, 0.0, 0.0);
        bar.mesh = 1;
    }
    scene.cameras.emplace_back().fov_y_rad = 0.1;
    add_node(scene, {0.0, 8.0, 0.0}, {0.0, 1.0, 0.0}).camera = 0;
    add_lights(scene);
    return scene;
}

/// Width that a light states, and whether the bars' shadow is whole.
struct Shown {
    double stated_m = 0.0;
    bool whole = false;
};

class ResolvedWidths : public TruthTest, public ::testing::WithParamInterface<const char*> {
protected:
    static std::vector<Shown> shown(Pattern pattern, double width_m, double angle_rad) {
        bench::StageOptions options;
        options.size_px = {400, 300};
        options.scene = "bars";
        options.settings = {std::string("filter=") + GetParam(), "resolution=256", "cascade_blend=0"};
        auto stage = bench::Stage::open(options, bars_scene(pattern, width_m, angle_rad));
        std::vector<Shown> lights;
        if (!stage) {
            ADD_FAILURE() << to_line(stage.error());
            return lights;
        }
        for (const bench::LightAccuracy& light : measure(*stage.value()).lights) {
            const auto& each = light.metrics.edge.each;
            EXPECT_GE(each.size(), kLeastPlaces);
            const auto off = std::count_if(each.begin(), each.end(), [&](const oracle::EdgeDisplacement::Place& place) {
                return place.off_px > light.report.predicted_error_px || place.off_px >= oracle::kEdgeSearchPx;
            });
            EXPECT_EQ(bench::broken_words(light), "") << light.report.name;
            lights.push_back(
                {light.report.resolved.m, static_cast<double>(off) <= kMostOff * static_cast<double>(each.size())});
        }
        return lights;
    }
};

TEST_P(ResolvedWidths, AreThoseFromWhichOnShadowsAreWholeInEveryDirection) {
    for (const Pattern pattern : kPatterns) {
        SCOPED_TRACE(kPatternNames[static_cast<int>(pattern)]);
        std::array<int, 3> broken_until{};  // largest step at which some direction is not whole
        broken_until.fill(kLeastStep - 1);
        const std::vector<Shown> wide = shown(pattern, 0.04, 0.0);
        ASSERT_EQ(wide.size(), 3u);
        const double stated_m = std::max({wide[0].stated_m, wide[1].stated_m, wide[2].stated_m});
        for (int step = kLeastStep; step <= kMostStep; ++step)
            for (const double angle_rad : kAngles_rad) {
                const std::vector<Shown> lights = shown(pattern, stated_m * std::exp2(0.25 * step), angle_rad);
                ASSERT_EQ(lights.size(), 3u);
                for (std::size_t i = 0; i < 3; ++i) {
                    EXPECT_NEAR(lights[i].stated_m, stated_m, 0.15 * stated_m);
                    if (!lights[i].whole) broken_until[i] = step;
                }
            }
        for (const int step : broken_until) {
            std::printf("%s: not whole up to %.2f of the stated width\n", kPatternNames[static_cast<int>(pattern)],
                        step < kLeastStep ? 0.0 : std::exp2(0.25 * step));
            EXPECT_LT(step, 0) << "the stated width suffices";
            EXPECT_GE(step, -4) << "half of it does not";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Filters, ResolvedWidths, ::testing::Values("triangles"));

}  // namespace
}  // namespace gnomon
