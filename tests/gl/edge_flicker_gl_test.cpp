#include <gtest/gtest.h>

#include <cstdio>
#include <glm/gtc/quaternion.hpp>

#include "bench/flicker/edge_flicker.h"
#include "engine/math/frustum.h"
#include "sample_game/support/built_in_scenes/primitives.h"

// Edges of shadows over time, against the lit share of each pixel's area (bench stability --area).
namespace gnomon {
namespace {

constexpr double kMostRatio = 0.25;
// Fewer pairs of a light prove nothing.
constexpr std::size_t kLeastPairs = 100;
constexpr std::size_t kLights = 3, kPaths = 5;

void add_mesh(assets::SceneData& scene, const game::Shape& shape) {
    assets::Mesh& mesh = scene.meshes.emplace_back();
    for (std::size_t i = 0; i < shape.positions.size(); ++i)
        mesh.vertices.push_back({shape.positions[i], shape.normals[i], shape.uvs[i]});
    mesh.indices = shape.indices;
    mesh.submeshes = {{0, static_cast<std::uint32_t>(shape.indices.size()), 0}};
    assets::complete(mesh);
}

assets::Node& add_node(assets::SceneData& scene, const char* name, const glm::dvec3& at_m, const glm::dvec3& back) {
    assets::Node& node = scene.nodes.emplace_back();
    node.name = name;
    node.translation_m = at_m;
    node.rotation = glm::quat_cast(math::basis_from_back(glm::normalize(back)));
    return node;
}

void add_light(assets::SceneData& scene, assets::LightType type, const char* name, const glm::dvec3& at_m) {
    assets::LightData& light = scene.lights.emplace_back();
    light.type = type;
    light.name = name;
    light.intensity = type == assets::LightType::directional ? 2000.0f : 1000.0f;
    light.outer_cone_rad = 0.8f;
    add_node(scene, name, at_m, at_m).light = static_cast<std::int32_t>(scene.lights.size() - 1);
}

/// Makes a ground under a turned box, a ball and a rail, with a light of each kind.
assets::SceneData things_on_a_ground() {
    assets::SceneData scene;
    scene.name = "things";
    scene.materials.emplace_back().metallic = 0.0f;
    add_mesh(scene, game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 8.0}, {8.0, 0.0, 0.0}));
    add_mesh(scene, game::make_box({-0.5, 0.0, -0.5}, {0.5, 1.2, 0.5}));
    add_mesh(scene, game::make_sphere(0.6, 24, 12));
    add_mesh(scene, game::make_bar({-2.0, 0.8, 1.4}, {1.7, 1.0, 1.9}, 0.08, 8));
    const glm::dvec3 places_m[] = {{0.0, 0.0, 0.0}, {-1.3, 0.1, 0.3}, {1.2, 0.9, -0.4}, {0.0, 0.0, 0.0}};
    for (std::int32_t i = 0; i < 4; ++i) {
        assets::Node& node = add_node(scene, "thing", places_m[i], {0.0, 0.0, 1.0});
        node.mesh = i;
        if (i == 1) node.rotation = glm::angleAxis(0.5, glm::normalize(glm::dvec3(0.2, 1.0, 0.1)));
    }
    add_light(scene, assets::LightType::directional, "sun", {2.0, 4.0, 1.1});
    add_light(scene, assets::LightType::spot, "spot", {-2.5, 5.0, 1.3});
    add_light(scene, assets::LightType::point, "point", {0.3, 3.1, 0.2});
    scene.cameras.emplace_back();
    add_node(scene, "camera", {1.0, 4.0, 5.0}, {1.0, 4.0, 5.0}).camera = 0;
    return scene;
}

auto open_stage(glm::uvec2 size_px) {
    bench::StageOptions options;
    options.size_px = size_px;
    return bench::Stage::open(options, things_on_a_ground());
}

bench::EdgeFlickers measure(const bench::EdgeFlickerOptions& options) {
    auto stage = open_stage({320, 180});
    if (!stage) {
        ADD_FAILURE() << to_line(stage.error());
        return {};
    }
    auto flickers = bench::measure_edge_flicker(*stage.value(), options);
    if (!flickers) {
        ADD_FAILURE() << to_line(flickers.error());
        return {};
    }
    EXPECT_EQ(stage.value()->gl_complaints(), 0u);
    std::fputs(bench::edge_flicker_table(flickers.value()).c_str(), stdout);
    return std::move(flickers).value();
}

bool holds(const bench::EdgeFlicker& row) { return row.compared[0].mean > 0.0 && row.ratio() <= kMostRatio; }

TEST(EdgeFlickerGl, OfAntialiasedEdgesIsAQuarterAtMostOnEachPathUnderEachLight) {
    bench::EdgeFlickerOptions options;
    options.frames = 6;
    options.points = 150;
    options.area_side = 12;
    const bench::EdgeFlickers flickers = measure(options);
    ASSERT_EQ(flickers.rows.size(), kPaths * kLights);
    for (const bench::EdgeFlicker& row : flickers.rows) {
        SCOPED_TRACE(row.path + ", " + row.light);
        EXPECT_EQ(row.reason, "");
        EXPECT_GE(row.compared[0].pairs, kLeastPairs);
        EXPECT_EQ(row.compared[0].pairs, row.compared[1].pairs);
        EXPECT_TRUE(holds(row)) << row.ratio();
    }
}

TEST(EdgeFlickerGl, WithoutAntialiasedEdgesIsFoundTooLarge) {
    bench::EdgeFlickerOptions options;
    options.frames = 6;
    options.points = 100;
    options.area_side = 8;
    options.paths = {"pan", "jitter"};
    options.compared = {"antialias=off", "antialias=off"};
    const bench::EdgeFlickers flickers = measure(options);
    ASSERT_EQ(flickers.rows.size(), 2 * kLights);
    for (const bench::EdgeFlicker& row : flickers.rows) {
        SCOPED_TRACE(row.path + ", " + row.light);
        EXPECT_GE(row.compared[0].pairs, kLeastPairs);
        EXPECT_FALSE(holds(row));
        EXPECT_EQ(row.compared[0].mean, row.compared[1].mean) << "the same frames differ";
    }
}

TEST(EdgeFlickerGl, OfAnUnknownPathIsAnError) {
    auto stage = open_stage({64, 36});
    ASSERT_TRUE(stage);
    bench::EdgeFlickerOptions options;
    options.paths = {"fly"};
    const auto flickers = bench::measure_edge_flicker(*stage.value(), options);
    ASSERT_FALSE(flickers);
    EXPECT_EQ(flickers.error().rule, "bench.path");
}

}  // namespace
}  // namespace gnomon
