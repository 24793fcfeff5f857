#include "sample_game/support/scene/spawn_scene.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "engine/math/aabb.h"
#include "gnomon/components.h"
#include "gnomon/light.h"
#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/scene/unique_names.h"

namespace gnomon::game {
namespace {

/// Makes a box from -1 to 1 with its faces outward, or inward for a room.
assets::Mesh box_mesh(bool inward) {
    assets::Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.vertices.push_back({.position_ms = {i & 4 ? 1.f : -1.f, i & 2 ? 1.f : -1.f, i & 1 ? 1.f : -1.f}});
    const std::uint32_t quads[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                       {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    for (const auto& q : quads) {
        if (inward)
            mesh.indices.insert(mesh.indices.end(), {q[0], q[2], q[1], q[0], q[3], q[2]});
        else
            mesh.indices.insert(mesh.indices.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
    }
    mesh.submeshes.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), 0});
    mesh.bounds_ms = {glm::dvec3(-1.0), glm::dvec3(1.0)};
    return mesh;
}

assets::SceneData one_box(bool inward = false, const glm::dvec3& at = glm::dvec3(0.0)) {
    assets::SceneData scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(box_mesh(inward));
    assets::Node node;
    node.name = "box";
    node.mesh = 0;
    node.translation_m = at;
    scene.nodes.push_back(node);
    return scene;
}

struct Spawned {
    ecs::Registry registry;
    assets::MeshLibrary library;
    SpawnedScene scene;
    explicit Spawned(assets::SceneData data) { scene = spawn_scene(std::move(data), registry, library); }
};

TEST(Spawn, AMeshCastsAndReceivesUnlessItsNodeSaysOtherwise) {
    assets::SceneData data = one_box();
    data.nodes.push_back(data.nodes[0]);
    data.nodes[1].casts_shadow = data.nodes[1].receives_shadow = data.nodes[1].visible = false;
    data.nodes[1].shadow_catcher = true;
    const Spawned s(std::move(data));
    EXPECT_TRUE(s.registry.has<ShadowCaster>(s.scene.nodes[0]));
    EXPECT_TRUE(s.registry.get<MeshRef>(s.scene.nodes[0])->receives_shadow);
    EXPECT_FALSE(s.registry.has<ShadowCaster>(s.scene.nodes[1]));
    EXPECT_FALSE(s.registry.get<MeshRef>(s.scene.nodes[1])->receives_shadow);
    EXPECT_FALSE(s.registry.get<MeshRef>(s.scene.nodes[1])->visible);
    EXPECT_TRUE(s.registry.get<MeshRef>(s.scene.nodes[1])->shadow_catcher);
    EXPECT_FALSE(s.registry.get<MeshRef>(s.scene.nodes[0])->shadow_catcher);
    EXPECT_EQ(s.library.meshes.size(), 1u);
}

TEST(Spawn, ChildrenNameTheirParents) {
    assets::SceneData data = one_box();
    data.nodes.push_back(data.nodes[0]);
    data.nodes[1].parent = 0;
    const Spawned s(std::move(data));
    EXPECT_EQ(s.registry.get<Transform>(s.scene.nodes[0])->parent, ecs::kNull);
    EXPECT_EQ(s.registry.get<Transform>(s.scene.nodes[1])->parent, s.scene.nodes[0]);
}

TEST(Spawn, ASceneWithoutLightGetsASunFromAboveThatIsNotAxisAligned) {
    const Spawned s(one_box());
    EXPECT_TRUE(s.scene.sun_added);
    ASSERT_EQ(s.scene.lights.size(), 1u);
    const ecs::Entity sun = s.scene.lights[0].entity;
    EXPECT_EQ(s.registry.get<Light>(sun)->kind, LightKind::directional);
    EXPECT_GE(s.registry.get<Light>(sun)->intensity, 10000.0f);
    EXPECT_TRUE(s.registry.has<LightShadow>(sun));
    const glm::dvec3 to_sun = s.registry.get<Transform>(sun)->rotation * glm::dvec3(0.0, 0.0, 1.0);
    EXPECT_NEAR(std::asin(to_sun.y), 60.0 * glm::pi<double>() / 180.0, 1e-9);
    EXPECT_GT(std::abs(to_sun.x), 0.1);
    EXPECT_GT(std::abs(to_sun.z), 0.1);
}

TEST(Spawn, ALightWithoutShadowHasNoLightShadow) {
    assets::SceneData data = one_box();
    data.lights.resize(2);
    data.lights[1].casts_shadow = false;
    for (std::int32_t i = 0; i < 2; ++i) {
        data.nodes.emplace_back();
        data.nodes.back().light = i;
    }
    const Spawned s(std::move(data));
    EXPECT_FALSE(s.scene.sun_added);
    EXPECT_TRUE(s.registry.has<LightShadow>(s.scene.lights[0].entity));
    EXPECT_FALSE(s.registry.has<LightShadow>(s.scene.lights[1].entity));
    EXPECT_EQ(s.scene.lights[1].name, "light1");
    EXPECT_EQ(s.registry.get<Name>(s.scene.lights[1].entity)->text, "light1");
}

TEST(Spawn, ExactlyOneCameraIsActive) {
    assets::SceneData data = one_box();
    data.cameras.resize(2);
    for (std::int32_t i = 0; i < 2; ++i) {
        data.nodes.emplace_back();
        data.nodes.back().camera = i;
    }
    data.nodes[2].name = "1";  // a name wins over an index
    data.nodes[1].name = "front";
    Spawned s(std::move(data));
    const auto active = [&](std::size_t i) { return s.registry.get<Camera>(s.scene.cameras[i].entity)->active; };
    EXPECT_TRUE(active(0) && !active(1));
    EXPECT_TRUE(std::isinf(s.registry.get<Camera>(s.scene.cameras[0].entity)->far_m));
    activate_camera(s.scene, 1, s.registry);
    EXPECT_TRUE(!active(0) && active(1));
    EXPECT_EQ(find_camera(s.scene, "front").value(), 0u);
    EXPECT_EQ(find_camera(s.scene, "1").value(), 1u);
    EXPECT_EQ(find_camera(s.scene, "0").value(), 0u);
    ASSERT_FALSE(find_camera(s.scene, "2"));
    EXPECT_EQ(find_camera(s.scene, "2").error().rule, "camera.unknown");
}

/// Returns the box's corners as the framed camera sees them: (x, y) / half of the picture's height; z > 0 in front.
std::vector<glm::dvec3> corners_seen(const Spawned& s, const math::Aabb& box) {
    const Transform& at = *s.registry.get<Transform>(s.scene.cameras[0].entity);
    const double tan_y = std::tan(0.5 * s.registry.get<Camera>(s.scene.cameras[0].entity)->fov_y_rad);
    std::vector<glm::dvec3> seen;
    for (const glm::dvec3& corner : math::corners(box)) {
        const glm::dvec3 v = glm::conjugate(at.rotation) * (corner - at.translation_m);
        seen.emplace_back(v.x / -v.z / tan_y, v.y / -v.z / tan_y, -v.z);
    }
    return seen;
}

TEST(Framing, AnObjectIsSeenWholeFromOutsideAtAnySizeAndPlace) {
    for (const double size : {1e-4, 1.0, 1e6}) {
        assets::SceneData data = one_box(false, {1e6, 5.0, -3.0});
        data.nodes[0].scale = glm::dvec3(size);
        const Spawned s(std::move(data));
        EXPECT_TRUE(s.scene.camera_added);
        double reach = 0.0;
        for (const glm::dvec3& c : corners_seen(s, s.scene.bounds_ws)) {
            EXPECT_GT(c.z, s.registry.get<Camera>(s.scene.cameras[0].entity)->near_m);
            EXPECT_LE(std::abs(c.x), 16.0 / 9.0);
            EXPECT_LE(std::abs(c.y), 1.0);
            reach = std::max({reach, std::abs(c.y), std::abs(c.x) * 9.0 / 16.0});
        }
        EXPECT_GT(reach, 0.8) << "the box is too small in the picture at size " << size;
    }
}

TEST(Framing, ARoomIsSeenFromWithin) {
    const Spawned s(one_box(true));
    const glm::dvec3 at = s.registry.get<Transform>(s.scene.cameras[0].entity)->translation_m;
    EXPECT_TRUE(glm::all(glm::lessThan(glm::abs(at), glm::dvec3(1.0)))) << at.x << " " << at.y << " " << at.z;
    const glm::dvec3 forward =
        s.registry.get<Transform>(s.scene.cameras[0].entity)->rotation * glm::dvec3(0.0, 0.0, -1.0);
    EXPECT_LT(glm::dot(forward, at), 0.0) << "it must look through the centre";
}

TEST(Framing, AnEmptySceneStillHasACamera) {
    assets::SceneData empty;
    empty.materials.emplace_back();
    const Spawned s(std::move(empty));
    EXPECT_EQ(s.scene.cameras.size(), 1u);
    EXPECT_EQ(s.scene.lights.size(), 1u);
}

TEST(LightNames, AreFitForFilesAndUnique) {
    LightNames names;
    EXPECT_EQ(names.next("a lamp/b", "x", 0), "a_lamp_b");
    EXPECT_EQ(names.next("a lamp/b", "x", 1), "a_lamp_b.1");
    EXPECT_EQ(names.next("", "own", 2), "own");
    EXPECT_EQ(names.next("", "", 3), "light3");
    EXPECT_EQ(names.next("a_lamp_b.1", "", 4), "a_lamp_b.1.1");
    EXPECT_EQ(names.next("a lamp/b", "", 5), "a_lamp_b.2");
    EXPECT_EQ(names.next("../../etc", "", 6), ".._.._etc");
}

TEST(LightNames, AreShortEnoughForFilesAndStillUnique) {
    LightNames names;
    const std::string longer(300, 'x');
    EXPECT_EQ(names.next(longer, "", 0), std::string(200, 'x'));
    EXPECT_EQ(names.next(longer + "y", "", 1), std::string(200, 'x') + ".1");
    EXPECT_EQ(names.next("", longer, 2), std::string(200, 'x') + ".2");
    EXPECT_EQ(names.next(std::string(200, 'x'), "", 3), std::string(200, 'x') + ".3");
    EXPECT_EQ(names.next(std::string(199, 'x'), "", 4), std::string(199, 'x')) << "what fits is kept whole";
}

}  // namespace
}  // namespace gnomon::game
