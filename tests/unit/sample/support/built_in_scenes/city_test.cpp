#include "sample_game/support/built_in_scenes/city/city.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/assets.h"
#include "sample_game/inside/scene_bounds.h"
#include "sample_game/support/scene/node_transforms.h"

namespace gnomon::game {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// All lamps and all traffic are in the middle, so that a small city has them, too.
constexpr CityOptions kSmall{.blocks = 12};
constexpr int kMoving = 96 + 60, kOfBlock = 42;

assets::SceneData load(const CityOptions& options) {
    auto scene = assets::load_gltf_memory(make_city(options).glb, {}, "city");
    EXPECT_TRUE(scene) << to_line(scene.error());
    return std::move(scene).value();
}

int instances(const assets::SceneData& scene) {
    return static_cast<int>(std::count_if(scene.nodes.begin(), scene.nodes.end(),
                                          [](const assets::Node& node) { return node.mesh != assets::kNone; }));
}

TEST(City, IsTheSameBytesEveryTime) {
    EXPECT_EQ(make_city({.blocks = 2}).glb, make_city({.blocks = 2}).glb);
    EXPECT_NE(make_city({.blocks = 2}).glb, make_city({.blocks = 3}).glb);
}

TEST(City, HasMoreThanAHundredThousandThingsInFourKilometres) {
    const int blocks = CityOptions{}.blocks;
    EXPECT_GT(blocks * blocks * kOfBlock, 100000);
    EXPECT_EQ(instances(load(kSmall)), kSmall.blocks * kSmall.blocks * kOfBlock + kMoving);
    EXPECT_EQ(instances(load({.blocks = 1})), kOfBlock + kMoving);
    const assets::SceneData scene = load(kSmall);
    const math::Aabb bounds = scene_bounds(scene, world_poses(scene));
    EXPECT_NEAR((bounds.max.x - bounds.min.x) * blocks / kSmall.blocks, 4000.0, 1.0);
}

TEST(City, HasThreeHundredLampsASunAndSixCameras) {
    const assets::SceneData scene = load(kSmall);
    EXPECT_THAT(scene.warnings, IsEmpty());
    int suns = 0, lamps = 0, moving = 0;
    for (const assets::Node& node : scene.nodes) {
        if (node.light == assets::kNone) continue;
        const bool spot = scene.lights[node.light].type == assets::LightType::spot;
        ++(spot ? lamps : suns);
        moving += node.name.ends_with("_headlamp") ? 1 : 0;
    }
    EXPECT_EQ(suns, 1);
    EXPECT_EQ(lamps, 300);
    EXPECT_EQ(moving, 24);
    std::vector<std::string> cameras;
    for (const auto& camera : scene.cameras) cameras.push_back(camera.name);
    EXPECT_THAT(cameras, ElementsAre("street", "roof", "air", "walk", "drive", "fly"));
    ASSERT_EQ(scene.animations.size(), 1u);
    EXPECT_EQ(scene.animations[0].channels.size(), kMoving + 3u) << "and three cameras";
}

TEST(City, StreetLampsHangOverTheStreetAndShineDown) {
    const assets::SceneData scene = load(kSmall);
    const auto poses = world_poses(scene);
    int lamps = 0;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!scene.nodes[i].name.ends_with("_light")) continue;
        ++lamps;
        EXPECT_NEAR(poses[i].translation_ws_m.y, 6.54, 1e-6) << scene.nodes[i].name;
        EXPECT_NEAR(poses[i].basis[2].y, 1.0, 1e-6) << scene.nodes[i].name << ": shines along -z";
        const double x = std::abs(std::remainder(poses[i].translation_ws_m.x, 80.0)),
                     z = std::abs(std::remainder(poses[i].translation_ws_m.z, 80.0));
        EXPECT_GT(std::max(x, z), 32.5) << scene.nodes[i].name << ": beyond the kerb";
    }
    EXPECT_EQ(lamps, 276);
}

TEST(City, MeshesAreClosedUnlessTheyAreStreetsOrLeaves) {
    for (const assets::Mesh& mesh : load({.blocks = 1}).meshes) {
        EXPECT_EQ(mesh.topology.closed, mesh.name != "street" && mesh.name != "leaf_tree") << mesh.name;
        EXPECT_EQ(mesh.topology.degenerate_faces, 0u) << mesh.name;
    }
}

}  // namespace
}  // namespace gnomon::game
