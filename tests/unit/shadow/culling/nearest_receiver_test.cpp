#include "systems/shadow/culling/nearest_receiver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/mesh/mesh_shape.h"
#include "systems/extract/scene_tree.h"
#include "tests/unit/not_finite.h"
#include "tests/unit/shadow/random_scene.h"

namespace gnomon::shadow {
namespace {

/// Meshes and where they stand. Their shapes are the scene's; a mesh may be left without one.
struct Meshes {
    SceneSnapshot scene;
    std::vector<assets::Mesh> meshes;

    std::uint32_t add(assets::Mesh mesh, bool shaped = true) {
        for (const assets::Vertex& v : mesh.vertices)
            mesh.bounds_ms = math::extended(mesh.bounds_ms, glm::dvec3(v.position_ms));
        scene.meshes.shapes.push_back(shaped ? assets::shape_of(mesh) : nullptr);
        meshes.push_back(std::move(mesh));
        return static_cast<std::uint32_t>(meshes.size() - 1);
    }
    InstanceItem& place(std::uint32_t mesh, const glm::dmat3& basis = glm::dmat3(1.0),
                        const glm::dvec3& translation_ws_m = glm::dvec3(0.0)) {
        InstanceItem item;
        item.mesh = mesh;
        item.basis = basis;
        item.translation_ws_m = translation_ws_m;
        item.winding.mirrored = glm::determinant(basis) < 0.0;
        item.bounds_ws = math::transformed(meshes[mesh].bounds_ms, basis, translation_ws_m);
        scene.instances.push_back(item);
        return scene.instances.back();
    }
    double nearest_m(ShadowLayers layers = kAllShadowLayers) const {
        std::vector<glm::dvec3> scratch;
        return nearest_receiver_m(scene, scene.consumers.front(), layers, scratch);
    }
};

void add_triangle(assets::Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    for (const glm::dvec3& p : {a, b, c}) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
        mesh.vertices.push_back({glm::vec3(p), {}, {}});
    }
}

/// Adds a rectangle of `cells` by `cells` pairs of triangles from `corner` along `u` and `v`.
void add_wall(assets::Mesh& mesh, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, int cells = 16) {
    const auto at = [&](int i, int k) { return corner + u * (double(i) / cells) + v * (double(k) / cells); };
    for (int i = 0; i < cells; ++i)
        for (int k = 0; k < cells; ++k) {
            add_triangle(mesh, at(i, k), at(i + 1, k), at(i + 1, k + 1));
            add_triangle(mesh, at(i, k), at(i + 1, k + 1), at(i, k + 1));
        }
}

/// Makes a room 12 m wide, 4 m high and 8 m deep, its floor's middle in the origin.
assets::Mesh room() {
    assets::Mesh mesh;
    add_wall(mesh, {-6, 0, -4}, {12, 0, 0}, {0, 0, 8});
    add_wall(mesh, {-6, 4, -4}, {12, 0, 0}, {0, 0, 8});
    add_wall(mesh, {-6, 0, -4}, {12, 0, 0}, {0, 4, 0});
    add_wall(mesh, {-6, 0, 4}, {12, 0, 0}, {0, 4, 0});
    add_wall(mesh, {-6, 0, -4}, {0, 0, 8}, {0, 4, 0});
    add_wall(mesh, {6, 0, -4}, {0, 0, 8}, {0, 4, 0});
    return mesh;
}

assets::Mesh soup(RandomScene& random, std::size_t triangles) {
    assets::Mesh mesh;
    for (std::size_t i = 0; i < triangles; ++i) {
        const glm::dvec3 at = random.vector(6.0);
        const double size = i % 6 == 0 ? 6.0 : 0.4;
        add_triangle(mesh, at + random.vector(size), at + random.vector(size), at + random.vector(size));
    }
    return mesh;
}

ConsumerItem camera_at(const glm::dvec3& place_ws_m, const glm::dvec3& along) {
    ConsumerItem camera;
    camera.position_ws_m = place_ws_m;
    camera.rotation_ws = math::basis_from_back(-along);
    camera.near_m = 0.002;
    camera.far_m = kInfinity;
    camera.viewport_px = {640, 360};
    return camera;
}

/// Draws any turn, stretch along each axis and shear, mirrored half of the time.
glm::dmat3 any_basis(RandomScene& random) {
    glm::dmat3 basis = math::basis_from_back(random.direction());
    for (int axis = 0; axis < 3; ++axis) basis[axis] *= random.number(0.3, 2.0);
    basis[0] += basis[1] * random.number(-0.5, 0.5);
    if (random.number(0.0, 1.0) < 0.5) basis[1] = -basis[1];
    return basis;
}

Meshes random_meshes(RandomScene& random) {
    Meshes world;
    for (int m = 0; m < 4; ++m)
        world.add(soup(random, static_cast<std::size_t>(random.number(1.0, 80.0))),
                  m < 3 || random.number(0.0, 1.0) < 0.5);
    for (int i = 0; i < 7; ++i) {
        InstanceItem& item = world.place(static_cast<std::uint32_t>(i) % 4, any_basis(random), random.vector(10.0));
        item.visible = random.number(0.0, 1.0) < 0.8;
        item.receives = random.number(0.0, 1.0) < 0.8;
    }
    ConsumerItem camera = camera_at(random.vector(8.0), random.direction());
    camera.fov_y_rad = random.number(0.2, 2.2);
    if (random.number(0.0, 1.0) < 0.3) {
        camera.projection = CameraProjection::orthographic;
        camera.half_height_m = random.number(0.5, 4.0);
        camera.near_m = random.number(-3.0, 1.0);
        camera.far_m = 40.0;
    }
    world.scene.consumers.push_back(camera);
    return world;
}

bool sees(const ConsumerItem& c, const glm::dvec3& p_ws) {
    if (c.projection == CameraProjection::perspective) return seen(c, p_ws);
    const glm::dvec3 p = (p_ws - c.position_ws_m) * c.rotation_ws;
    return -p.z > c.near_m && -p.z < c.far_m && std::abs(p.y) < c.half_height_m &&
           std::abs(p.x) < c.half_height_m * aspect(c);
}

/// Returns the least view depth of many points on receivers, where the camera sees them.
double sampled_m(const Meshes& world, RandomScene& random) {
    const ConsumerItem& camera = world.scene.consumers.front();
    double least_m = kInfinity;
    for (const InstanceItem& item : world.scene.instances) {
        if (!item.visible || !item.receives) continue;
        const assets::Mesh& mesh = world.meshes[item.mesh];
        for (std::size_t first = 0; first < mesh.indices.size(); first += 3)
            for (int k = 0; k < 30; ++k) {
                double u = random.number(0.0, 1.0), v = random.number(0.0, 1.0);
                if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
                const auto corner = [&](std::size_t i) {
                    return glm::dvec3(mesh.vertices[mesh.indices[first + i]].position_ms);
                };
                const glm::dvec3 p_ms = corner(0) * (1.0 - u - v) + corner(1) * u + corner(2) * v;
                const glm::dvec3 p_ws = item.basis * p_ms + item.translation_ws_m;
                if (!sees(camera, p_ws)) continue;
                least_m = std::min(least_m, -glm::dot(p_ws - camera.position_ws_m, camera.rotation_ws[2]));
            }
    }
    return least_m;
}

TEST(NearestReceiver, IsNoFartherThanAnyPointThatIsSeen) {
    RandomScene random(print_seed());
    int seen = 0, unseen = 0, farther = 0;
    for (int round = 0; round < 300; ++round) {
        Meshes world = random_meshes(random);
        const double found_m = world.nearest_m(), least_m = sampled_m(world, random);
        ASSERT_LE(found_m, least_m) << "round " << round;
        ++(std::isfinite(least_m) ? seen : unseen);
        build_tree(world.scene);
        EXPECT_EQ(world.nearest_m(), found_m) << "by the instances' tree";
        world.scene.meshes.shapes.clear();
        const double by_bounds_m = world.nearest_m();
        EXPECT_LE(by_bounds_m, found_m * (1.0 + 1e-5) + 1e-4) << "bounds know less";
        farther += found_m > by_bounds_m + 0.5 ? 1 : 0;
    }
    EXPECT_GT(seen, 200);
    EXPECT_GT(unseen, 3);
    EXPECT_GT(farther, 40) << "else the bounds would do";
}

TEST(NearestReceiver, WouldBeCaughtIfAShapeWereTheUnmirroredOne) {
    RandomScene random(print_seed());
    // About one in fifteen is caught; half of that is four standard deviations below.
    constexpr int kManyRounds = 900, kLeastCaught = kManyRounds / 30;
    int caught = 0;
    for (int round = 0; round < kManyRounds; ++round) {
        Meshes world = random_meshes(random);
        world.scene.instances.resize(1);  // else another one is nearer as it is
        world.scene.instances[0].visible = world.scene.instances[0].receives = true;
        const double least_m = sampled_m(world, random);
        world.scene.instances[0].basis[0] *= -1.0;
        caught += world.nearest_m() > least_m ? 1 : 0;
    }
    EXPECT_GT(caught, kLeastCaught);
}

TEST(NearestReceiver, IsTheWallOfARoomAndNotItsBox) {
    Meshes world;
    world.place(world.add(room()));
    ConsumerItem camera = camera_at({0.0, 1.7, 1.0}, {0.0, 0.0, -1.0});
    camera.fov_y_rad = 0.5;  // sees the wall before it sees the floor
    world.scene.consumers = {camera};
    EXPECT_NEAR(world.nearest_m(), 5.0, 1e-3);
    EXPECT_LT(world.nearest_m(), 5.0);
    // Wider, it sees the floor first, 1.7 m below. A leaf's box reaches past the border by its own size at most.
    world.scene.consumers[0].fov_y_rad = 1.2;
    EXPECT_NEAR(world.nearest_m(), 1.7 / std::tan(0.6), 1e-3) << "the floor is flat along the box's sides";
    world.scene.meshes.shapes.clear();
    EXPECT_NEAR(world.nearest_m(), camera.near_m, 1e-4) << "the box is all around the camera";
}

TEST(NearestReceiver, OfAMirroredInstanceIsThatOfItsImage) {
    assets::Mesh wall;
    add_wall(wall, {2.0, -3.0, -3.0}, {0.0, 6.0, 0.0}, {0.0, 0.0, 6.0});
    Meshes world;
    const std::uint32_t mesh = world.add(wall);
    world.place(mesh, glm::dmat3({-2.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}));
    world.scene.consumers = {camera_at(glm::dvec3(0.0), {-1.0, 0.0, 0.0})};
    EXPECT_NEAR(world.nearest_m(), 4.0, 1e-4);
    world.scene.consumers = {camera_at(glm::dvec3(0.0), {1.0, 0.0, 0.0})};
    EXPECT_EQ(world.nearest_m(), kInfinity);
}

TEST(NearestReceiver, ScalesByPowersOfTwoToTheBit) {
    RandomScene random(print_seed());
    for (int round = 0; round < 60; ++round) {
        Meshes world = random_meshes(random);
        const double found_m = world.nearest_m();
        for (const int power : {-13, 26}) {
            const double by = std::exp2(power);
            Meshes scaled = world;
            for (InstanceItem& item : scaled.scene.instances) {
                item.basis *= by;
                item.translation_ws_m *= by;
                item.bounds_ws = {item.bounds_ws.min * by, item.bounds_ws.max * by};
            }
            ConsumerItem& camera = scaled.scene.consumers[0];
            camera.position_ws_m *= by;
            camera.near_m *= by;
            camera.far_m *= by;
            camera.half_height_m *= by;
            EXPECT_EQ(scaled.nearest_m(), found_m * by);
        }
    }
}

TEST(NearestReceiver, IsTheSameAMillionMetresAway) {
    RandomScene random(print_seed());
    const glm::dvec3 offset(std::exp2(20.0), -std::exp2(19.0), std::exp2(20.0));
    for (int round = 0; round < 100; ++round) {
        Meshes world = random_meshes(random);
        const double found_m = world.nearest_m();
        for (InstanceItem& item : world.scene.instances) {
            item.translation_ws_m += offset;
            item.bounds_ws = {item.bounds_ws.min + offset, item.bounds_ws.max + offset};
        }
        world.scene.consumers[0].position_ws_m += offset;
        if (std::isfinite(found_m))
            EXPECT_NEAR(world.nearest_m(), found_m, 1e-7);  // a place there is 1e-10 off
        else
            EXPECT_EQ(world.nearest_m(), found_m);
    }
}

TEST(NearestReceiver, CountsWhatReceivesOnALayerAndIsVisible) {
    assets::Mesh wall;
    add_wall(wall, {-3.0, -3.0, 0.0}, {6.0, 0.0, 0.0}, {0.0, 6.0, 0.0});
    Meshes world;
    const std::uint32_t mesh = world.add(wall);
    for (const double z : {-1.0, -2.0, -3.0, -4.0}) world.place(mesh, glm::dmat3(1.0), {0.0, 0.0, z});
    world.scene.consumers = {camera_at(glm::dvec3(0.0), {0.0, 0.0, -1.0})};
    EXPECT_NEAR(world.nearest_m(), 1.0, 1e-4);
    world.scene.instances[0].visible = false;
    EXPECT_NEAR(world.nearest_m(), 2.0, 1e-4);
    world.scene.instances[1].receives = false;
    EXPECT_NEAR(world.nearest_m(), 3.0, 1e-4);
    world.scene.instances[2].receive_layers = 2;
    EXPECT_NEAR(world.nearest_m(), 3.0, 1e-4);
    EXPECT_NEAR(world.nearest_m(1), 4.0, 1e-4);
    EXPECT_EQ(world.nearest_m(0), kInfinity);
}

TEST(NearestReceiver, OfAnEmptyWorldIsNowhere) {
    Meshes world;
    world.scene.consumers = {camera_at(glm::dvec3(0.0), {0.0, 0.0, -1.0})};
    EXPECT_EQ(world.nearest_m(), kInfinity);
    build_tree(world.scene);
    EXPECT_EQ(world.nearest_m(), kInfinity);
}

TEST(NearestReceiver, IsWithinTheBoundsWhereNumbersLeaveTheRangeOfDouble) {
    Meshes world;
    InstanceItem& item = world.place(world.add(room()));
    item.basis = glm::dmat3(1e-200);
    world.scene.consumers = {camera_at({0.0, 1.7, 1.0}, {0.0, 0.0, -1.0})};
    EXPECT_NEAR(world.nearest_m(), 0.002, 1e-4) << "by its bounds";
}

/// Makes a room with a sun above, seen from near its middle, and a caster that stands in it.
Meshes lit_room(ShadowFit fit) {
    Meshes world;
    world.place(world.add(room()));
    assets::Mesh post;
    add_wall(post, {0.0, 0.0, -2.0}, {0.3, 0.0, 0.0}, {0.0, 1.0, 0.0}, 2);
    world.place(world.add(post)).casts = true;
    ConsumerItem camera = camera_at({0.0, 1.7, 1.0}, {0.0, 0.0, -1.0});
    camera.fov_y_rad = 0.7;
    world.scene.consumers = {camera};
    LightItem sun;
    sun.kind = LightKind::directional;
    sun.intensity = 1.0f;
    sun.has_shadow = true;
    sun.shadow.resolution_px = 512;
    sun.tuning.cascades.fit = fit;
    sun.rotation_ws = math::basis_from_back({0.3, 1.0, 0.2});
    world.scene.lights = {sun};
    return world;
}

TEST(NearestReceiver, IsWhereTheFirstCascadeBegins) {
    for (const ShadowFit fit : {ShadowFit::tight, ShadowFit::quantised}) {
        Meshes world = lit_room(fit);
        const double nearest_m = world.nearest_m();
        EXPECT_GT(nearest_m, 2.5);
        const ShadowFrame found = fitted(world.scene);
        ASSERT_EQ(found.fitted.views.size(), 4u);
        EXPECT_LE(found.fitted.views[0].cascade.seen_from_m, nearest_m);
        EXPECT_GT(found.fitted.views[0].cascade.seen_from_m, nearest_m / std::exp2(0.5));
        world.scene.meshes.shapes.clear();
        const ShadowFrame by_bounds = fitted(world.scene);
        ASSERT_FALSE(by_bounds.fitted.views.empty());
        EXPECT_LT(by_bounds.fitted.views[0].cascade.seen_from_m, 0.1);
        EXPECT_LT(4.0 * found.fitted.views[0].error.texel_edge_px, by_bounds.fitted.views[0].error.texel_edge_px);
    }
}

TEST(NearestReceiver, MovesNoStableFit) {
    Meshes world = lit_room(ShadowFit::stable);
    const ShadowFrame found = fitted(world.scene);
    world.scene.meshes.shapes.clear();
    const ShadowFrame by_bounds = fitted(world.scene);
    for (const ShadowView& view : found.fitted.views) {
        const auto same = std::find_if(by_bounds.fitted.views.begin(), by_bounds.fitted.views.end(),
                                       [&](const ShadowView& v) { return v.layer == view.layer; });
        ASSERT_NE(same, by_bounds.fitted.views.end());
        EXPECT_EQ(same->clip_from_anchor, view.clip_from_anchor);
        EXPECT_EQ(same->cascade.seen_from_m, view.cascade.seen_from_m);
    }
}

TEST(NearestReceiver, OfAViewPastEverythingLeavesNothingToShadow) {
    Meshes world = lit_room(ShadowFit::tight);
    assets::Mesh floor;  // slanted, so that its box is around the camera
    add_wall(floor, {-6.0, -6.0, 4.0}, {12.0, 0.0, 0.0}, {0.0, 6.0, -8.0});
    world.place(world.add(floor));
    world.scene.instances[0].visible = false;
    world.scene.instances[1].visible = false;
    world.scene.consumers[0] = camera_at({0.0, -2.0, 3.0}, {0.0, 1.0, 0.5});
    EXPECT_EQ(world.nearest_m(), kInfinity);
    EXPECT_EQ(fitted(world.scene).statuses[0].skipped(), Reason::no_visible_receiver);
    world.scene.meshes.shapes.clear();
    EXPECT_NE(fitted(world.scene).statuses[0].skipped(), Reason::no_visible_receiver) << "its box is seen";
}

}  // namespace
}  // namespace gnomon::shadow
