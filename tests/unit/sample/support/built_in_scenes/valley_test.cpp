#include "sample_game/support/built_in_scenes/valley/valley.h"

#include <gmock/gmock.h>

#include <map>
#include <utility>

#include "engine/math/aabb.h"
#include "gnomon/assets.h"
#include "sample_game/inside/scene_bounds.h"
#include "sample_game/support/built_in_scenes/valley/parts.h"
#include "sample_game/support/scene/node_transforms.h"
#include "sample_game/support/scene/open_scene.h"

namespace gnomon::game {
namespace {

assets::SceneData load() {
    auto scene = load_scene(kValleyScene);
    EXPECT_TRUE(scene) << to_line(scene.error());
    return std::move(scene).value();
}

TEST(Valley, IsTheSameBytesEveryTime) { EXPECT_EQ(make_valley().glb, make_valley().glb); }

TEST(Valley, IsKilometresWideUnderOneSunWithThreeCameras) {
    const assets::SceneData scene = load();
    EXPECT_THAT(scene.warnings, ::testing::IsEmpty());
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].type, assets::LightType::directional);
    ASSERT_EQ(scene.cameras.size(), 3u);
    EXPECT_EQ(scene.cameras[0].name, "lane");
    const math::Aabb bounds = scene_bounds(scene, world_poses(scene));
    EXPECT_EQ(bounds.max.x - bounds.min.x, 2400.0);
    EXPECT_EQ(bounds.max.z - bounds.min.z, 2400.0);
    EXPECT_LT(make_valley().triangles, 300000u) << "a test draws it";
}

TEST(Valley, CamerasAndTheVillageStandOnTheGround) {
    const assets::SceneData scene = load();
    const auto poses = world_poses(scene);
    int houses = 0;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const glm::dvec3 at_m = poses[i].translation_ws_m;
        const double above_m = at_m.y - ground_height_m(at_m.x, at_m.z);
        if (scene.nodes[i].camera != assets::kNone) {
            EXPECT_GT(above_m, 1.5) << scene.nodes[i].name;
        }
        if (!scene.nodes[i].name.starts_with("house_")) continue;
        EXPECT_NEAR(above_m, 0.0, 1e-9) << scene.nodes[i].name;
        ++houses;
    }
    EXPECT_EQ(houses, 18);
}

/// Guards against gaps: light would fall through.
TEST(Valley, TilesOfTheGroundMeetExactly) {
    const assets::SceneData scene = load();
    const auto poses = world_poses(scene);
    std::map<std::pair<double, double>, double> heights;
    std::size_t shared = 0;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!scene.nodes[i].name.starts_with("ground_")) continue;
        for (const assets::Vertex& v : scene.meshes[scene.nodes[i].mesh].vertices) {
            const glm::dvec3 p = poses[i].translation_ws_m + glm::dvec3(v.position_ms);
            const auto [known, is_new] = heights.emplace(std::pair(p.x, p.z), p.y);
            shared += is_new ? 0 : 1;
            ASSERT_EQ(known->second, p.y) << p.x << " " << p.z;
        }
    }
    constexpr std::size_t kVerticesAcross = 16 * 12 + 1;
    EXPECT_EQ(heights.size(), kVerticesAcross * kVerticesAcross);
    EXPECT_GT(shared, 0u);
}

TEST(Valley, MeshesAreClosedUnlessTheyAreGroundOrLeaves) {
    for (const assets::Mesh& mesh : load().meshes) {
        const bool open = mesh.name.starts_with("ground_") || mesh.name == "leaf_tree";
        EXPECT_EQ(mesh.topology.closed, !open) << mesh.name;
        EXPECT_EQ(mesh.topology.degenerate_faces, 0u) << mesh.name;
    }
}

}  // namespace
}  // namespace gnomon::game
