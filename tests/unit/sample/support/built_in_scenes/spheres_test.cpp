#include "sample_game/support/built_in_scenes/spheres.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "gnomon/assets.h"
#include "sample_game/support/scene/node_transforms.h"
#include "sample_game/support/scene/open_scene.h"

namespace gnomon::game {
namespace {

TEST(Spheres, AreTheSameBytesEveryTime) { EXPECT_EQ(make_spheres().glb, make_spheres().glb); }

TEST(Spheres, AreSixtyThousandTrianglesUnderOneSun) {
    const auto loaded = load_scene(kSpheresScene);
    ASSERT_TRUE(loaded) << to_line(loaded.error());
    const assets::SceneData& scene = loaded.value();
    EXPECT_THAT(scene.warnings, ::testing::IsEmpty());
    EXPECT_EQ(make_spheres().triangles, 60000u + 12u) << "and the ground's";
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].type, assets::LightType::directional);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "main");
}

/// Checks what makes the scene hard: surfaces that meet without an edge between them.
TEST(Spheres, MeetEachOtherAndTheGround) {
    const auto loaded = load_scene(kSpheresScene);
    ASSERT_TRUE(loaded);
    const assets::SceneData& scene = loaded.value();
    const auto poses = world_poses(scene);
    std::size_t spheres = 0, meeting = 0;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!scene.nodes[i].name.starts_with("sphere_")) continue;
        const double radius_m = scene.meshes[scene.nodes[i].mesh].bounds_ms.max.y;
        const glm::dvec3 at_m = poses[i].translation_ws_m;
        EXPECT_LT(at_m.y, radius_m) << "above the ground";
        for (std::size_t k = 0; k < i; ++k)
            if (scene.nodes[k].name.starts_with("sphere_"))
                meeting += glm::distance(at_m, poses[k].translation_ws_m) < 2.0 * radius_m ? 1 : 0;
        ++spheres;
    }
    EXPECT_EQ(spheres, 25u);
    EXPECT_EQ(meeting, 2u * 5u * 4u) << "beside and behind";
}

}  // namespace
}  // namespace gnomon::game
