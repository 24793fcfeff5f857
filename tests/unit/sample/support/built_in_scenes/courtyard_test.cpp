#include "sample_game/support/built_in_scenes/courtyard/courtyard.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "engine/math/aabb.h"
#include "gnomon/assets.h"
#include "sample_game/inside/scene_bounds.h"
#include "sample_game/support/built_in_scenes/ear_clipping.h"
#include "sample_game/support/scene/node_transforms.h"
#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/extract/poses.h"
#include "systems/transform/transform_system.h"
#include "tests/long_run.h"

namespace gnomon::game {
namespace {

assets::SceneData load(const CourtyardOptions& options = {}) {
    auto scene = assets::load_gltf_memory(make_courtyard(options).glb, {}, "courtyard");
    EXPECT_TRUE(scene) << to_line(scene.error());
    return std::move(scene).value();
}

/// Computes the signed volume of a closed mesh: above 0 if it is wound outward.
double signed_volume(const assets::Mesh& mesh) {
    double volume = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return glm::dvec3(mesh.vertices[mesh.indices[i + k]].position_ms); };
        volume += glm::dot(corner(0), glm::cross(corner(1), corner(2))) / 6.0;
    }
    return volume;
}

TEST(Courtyard, IsTheSameBytesEveryTime) {
    EXPECT_EQ(make_courtyard().glb, make_courtyard().glb);
    EXPECT_NE(make_courtyard().glb, make_courtyard({.offset_m = {1.0, 0.0, 0.0}}).glb);
}

TEST(Courtyard, HasLightsOfAllKindsMovingThingsAndThreeCameras) {
    const assets::SceneData scene = load();
    EXPECT_THAT(scene.warnings, ::testing::IsEmpty());
    ASSERT_EQ(scene.lights.size(), 3u);
    std::set<assets::LightType> types;
    for (const assets::LightData& light : scene.lights) types.insert(light.type);
    EXPECT_EQ(types.size(), 3u);
    ASSERT_EQ(scene.cameras.size(), 3u);
    EXPECT_EQ(scene.cameras[0].name, "main");
    std::set<std::string> motions;
    for (const assets::Node& node : scene.nodes) motions.insert(node.motion.kind);
    EXPECT_THAT(motions, ::testing::UnorderedElementsAre("", "spin", "swing", "slide"));
    const std::uint64_t triangles = make_courtyard().triangles;
    EXPECT_GE(triangles, 5000u);
    EXPECT_LE(triangles, 30000u);
}

TEST(Courtyard, MeshesAreClosedAndOutwardUnlessTheyAreCloth) {
    for (const assets::Mesh& mesh : load().meshes) {
        const bool sheet = mesh.name == "cloth" || mesh.name == "tree_crown";
        EXPECT_EQ(mesh.topology.closed, !sheet) << mesh.name;
        EXPECT_EQ(mesh.topology.degenerate_faces, 0u) << mesh.name;
        EXPECT_TRUE(sheet || signed_volume(mesh) > 0.0) << mesh.name;
    }
}

TEST(Courtyard, NormalsPointToTheSideThatTheTriangleFaces) {
    for (const assets::Mesh& mesh : load().meshes) {
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto vertex = [&](std::size_t k) { return mesh.vertices[mesh.indices[i + k]]; };
            const glm::vec3 face = glm::cross(vertex(1).position_ms - vertex(0).position_ms,
                                              vertex(2).position_ms - vertex(0).position_ms);
            for (std::size_t k = 0; k < 3; ++k) ASSERT_GT(glm::dot(face, vertex(k).normal_ms), 0.0f) << mesh.name;
        }
    }
}

TEST(Courtyard, AnOffsetOfAMillionMetresMovesEveryNodeByExactlyThat) {
    const glm::dvec3 offset_m(1.0e6, 0.0, -1.0e6);
    const assets::SceneData near = load(), far = load({.offset_m = offset_m});
    const auto near_poses = world_poses(near), far_poses = world_poses(far);
    ASSERT_EQ(near_poses.size(), far_poses.size());
    for (std::size_t i = 0; i < near_poses.size(); ++i) {
        EXPECT_LT(glm::length(far_poses[i].translation_ws_m - near_poses[i].translation_ws_m - offset_m), 1e-9);
        EXPECT_EQ(far_poses[i].basis, near_poses[i].basis);
    }
}

TEST(Courtyard, AScaledOneIsAsBright) {
    const assets::SceneData one = load(), ten = load({.scale = 10.0});
    for (std::size_t i = 0; i < one.lights.size(); ++i) {
        const bool sun = one.lights[i].type == assets::LightType::directional;
        EXPECT_FLOAT_EQ(ten.lights[i].intensity, one.lights[i].intensity * (sun ? 1.0f : 100.0f));
    }
    const auto size = [](const assets::SceneData& s) {
        return glm::length(math::half_extent(scene_bounds(s, world_poses(s))));
    };
    EXPECT_NEAR(size(ten) / size(one), 10.0, 1e-9);
}

TEST(Courtyard, WithoutCastersNoMeshCasts) {
    const auto casting = [](const assets::SceneData& scene) {
        int count = 0;
        for (const assets::Node& node : scene.nodes) count += node.mesh != assets::kNone && node.casts_shadow;
        return count;
    };
    EXPECT_GT(casting(load()), 40);
    EXPECT_EQ(casting(load({.casters = false})), 0);
}

TEST(Courtyard, TheBuiltInSceneIsTheDefault) {
    const auto scene = load_scene(std::nullopt);
    ASSERT_TRUE(scene) << to_line(scene.error());
    EXPECT_EQ(scene.value().meshes.size(), load().meshes.size());
}

/// Computes the box around the guard's vertices in the world at a time.
math::Aabb guard_at(double time_s) {
    ecs::Registry registry;
    assets::MeshLibrary library;
    const SpawnedScene spawned = spawn_scene(load(), registry, library);
    set_time(spawned, time_s, registry);
    TransformSystem().update(registry);
    SceneSnapshot snapshot;
    snapshot.version = 1;
    PoseExtractor().list(registry, library, snapshot);
    EXPECT_EQ(snapshot.poses.size(), 1u);
    const PoseItem& pose = snapshot.poses.front();
    std::vector<assets::Vertex> vertices;
    assets::deform(library.meshes[pose.mesh], pose.pose(), vertices);
    math::Aabb box;
    for (const assets::Vertex& v : vertices) box = math::extended(box, pose.origin_ws_m + glm::dvec3(v.position_ms));
    return box;
}

TEST(Courtyard, TheGuardWalksUpAndDownWithHisFeetOnTheGround) {
    const math::Aabb start = guard_at(0.0);
    EXPECT_NEAR(start.min.y, 0.0, 1e-6);
    constexpr double kRound_s = 24.0, kLeast_m = 7.0;
    constexpr double kStep_s = kSanitized ? 1.11 : 0.37;
    double farthest = 0.0;
    for (double time_s = 0.0; time_s < kRound_s; time_s += kStep_s) {
        SCOPED_TRACE(time_s);
        const math::Aabb now = guard_at(time_s);
        EXPECT_GT(now.min.y, -0.04);  // a swinging boot dips a little
        EXPECT_LT(now.min.y, 0.1);
        EXPECT_GT(now.max.y, 2.2);
        EXPECT_LT(now.max.x - now.min.x, 1.7);
        farthest = std::max(farthest, glm::distance(math::centre(now), math::centre(start)));
    }
    EXPECT_GT(farthest, kLeast_m);
    const math::Aabb again = guard_at(kRound_s);
    EXPECT_LT(glm::length(again.min - start.min), 1e-9) << "his round begins anew";
}

TEST(Polygon, TrianglesOfAConcavePolygonCoverItsArea) {
    const std::array<glm::dvec2, 8> stairs{glm::dvec2(0, 0), {3, 0}, {3, 3}, {2, 3}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};
    double area = 0.0;
    const auto triangles = triangulate(stairs);
    EXPECT_EQ(triangles.size(), stairs.size() - 2);
    for (const auto& t : triangles) {
        const glm::dvec2 u = stairs[t[1]] - stairs[t[0]], v = stairs[t[2]] - stairs[t[0]];
        const double twice = u.x * v.y - u.y * v.x;
        EXPECT_GT(twice, 0.0);
        area += 0.5 * twice;
    }
    EXPECT_DOUBLE_EQ(area, 6.0);
}

}  // namespace
}  // namespace gnomon::game
