#include "systems/shadow/culling/lamp_offsets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "engine/gl/device_recording.h"
#include "engine/mesh/mesh_shape.h"
#include "tests/unit/oracle/analytic_scene.h"

namespace gnomon::test {
namespace {

constexpr double kReach_m = 7.0;  // from near the middle of a floor of at least 10 m
constexpr double kClear_m = shadow::kClearOfClipping * kReach_m;

/// From where shadows of lamps at these places are looked for, with boxes around triangles or without.
class LampPlacesTest : public ::testing::TestWithParam<bool> {
protected:
    glm::dvec3 place_of(const LightItem& light, const GpuScene& gpu) {
        scene.snapshot.lights = {light};
        shadow::ShadowRequest request;
        request.rays.used = by_rays;
        std::vector<glm::dvec3> lamps_ws_m;
        places.update(scene.snapshot, gpu, {&request, 1}, lamps_ws_m, {});
        return lamps_ws_m.at(0);
    }
    void finish() {
        scene.snapshot.meshes.shapes.clear();
        for (const assets::Mesh& mesh : scene.library.meshes)
            if (GetParam()) scene.snapshot.meshes.shapes.push_back(assets::shape_of(mesh));
        for (InstanceItem& item : scene.snapshot.instances) {
            item.bounds_ws = {};
            for (const assets::Vertex& vertex : scene.library.meshes[item.mesh].vertices)
                item.bounds_ws =
                    math::extended(item.bounds_ws, item.basis * glm::dvec3(vertex.position_ms) + item.translation_ws_m);
            item.version = ++scene.snapshot.version;
        }
    }
    glm::dvec3 place_of(const LightItem& light) {
        finish();
        gl::RecordingDevice device;
        auto gpu = GpuScene::create(device, scene.library);
        EXPECT_TRUE(gpu);
        return gpu ? place_of(light, gpu.value()) : glm::dvec3(NAN);
    }

    oracle::AnalyticScene scene;
    shadow::LampOffsets places;
    bool by_rays = false;
};

INSTANTIATE_TEST_SUITE_P(Shapes, LampPlacesTest, ::testing::Bool());

TEST_P(LampPlacesTest, AreClearOfTheFloorOnTheSideOnWhichTheLampIs) {
    scene.place_floor(10.0);
    for (const double height_m : {0.0, 1e-9, 1e-6, -1e-9, -1e-6}) {
        const glm::dvec3 at(0.3, height_m, -0.2);
        const glm::dvec3 place = place_of(scene.lamp(at)), step = place - at;
        const double above_m = height_m < 0.0 ? -place.y : place.y;
        EXPECT_GE(above_m, kClear_m) << height_m;
        EXPECT_LE(above_m, 2.0 * kClear_m) << height_m;
        EXPECT_EQ(glm::length(glm::dvec2(step.x, step.z)), 0.0) << height_m;
        EXPECT_EQ(place_of(scene.spot(at, {0.0, 1.0, 0.0}, 0.5)), place) << height_m;
    }
}

TEST_P(LampPlacesTest, AreTheLampsOwnWhereNothingTouchesThem) {
    scene.place_floor(10.0);
    for (const glm::dvec3 at : {glm::dvec3(0.3, 1e-3, -0.2), {0.3, -1e-3, -0.2}, {5.1, 0.0, 0.0}, {0.0, 3.0, 0.0}})
        EXPECT_EQ(place_of(scene.lamp(at)), at);
    const LightItem sun = scene.sun({1.0, 0.0, 0.0});
    EXPECT_EQ(place_of(sun), sun.position_ws_m);
    scene.snapshot.instances[0].casts = false;
    EXPECT_EQ(place_of(scene.lamp({0.3, 0.0, -0.2})), glm::dvec3(0.3, 0.0, -0.2)) << "what casts nothing";
}

TEST_P(LampPlacesTest, TakeTheFrontOfATurnedOrMirroredFloorForThatOfItsPlane) {
    const glm::dquat turn = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 2.0, 0.5)));
    const glm::dvec3 normal = turn * glm::dvec3(0.0, 0.0, 1.0), at(100.0, 3.0, -20.0);
    const std::uint32_t square = scene.add_square();
    for (const double side : {1.0, -1.0}) {  // mirrored, it faces the other way in the mesh's winding, not in the world
        scene.snapshot.instances.clear();
        scene.place(square, at, glm::mat3_cast(turn) * glm::dmat3({10.0 * side, 0, 0}, {0, 10, 0}, {0, 0, 1}));
        EXPECT_GT(glm::dot(place_of(scene.lamp(at)) - at, normal), kClear_m);
    }
}

TEST_P(LampPlacesTest, StandInACornerOfThreeWallsClearOfAll) {
    const std::uint32_t square = scene.add_square();
    scene.place(square, {0, 0, 0}, glm::dmat3(10.0));
    scene.place(square, {0, 0, 0}, glm::dmat3({0, 10, 0}, {0, 0, 10}, {10, 0, 0}));
    scene.place(square, {0, 0, 0}, glm::dmat3({0, 0, 10}, {10, 0, 0}, {0, 10, 0}));
    const glm::dvec3 place = place_of(scene.lamp({1e-9, -1e-8, 0.0}));
    EXPECT_GE(place.x, 0.99 * kClear_m);
    EXPECT_LE(place.y, -0.99 * kClear_m);
    EXPECT_GE(place.z, 0.99 * kClear_m) << "in the plane of the first: its front";
}

TEST_P(LampPlacesTest, AreNearerWhereRaysDecideAndWhereTrianglesAreSmall) {
    scene.place_floor(10.0);
    const LightItem lamp = scene.lamp({0.3, 0.0, -0.2});
    by_rays = true;
    EXPECT_GE(place_of(lamp).y, shadow::kClearOfPlanes * kReach_m);
    EXPECT_LE(place_of(lamp).y, 2.0 * shadow::kClearOfPlanes * kReach_m);
    by_rays = false;
    EXPECT_GE(place_of(lamp).y, kClear_m);
    // The same reach, of a small triangle beside a far one.
    scene.snapshot.instances.clear();
    const glm::vec3 far(5.0f, 0.0f, 5.0f);
    scene.place(scene.add_mesh({{-0.1f, 0, -0.1f}, {0, 0, 0.1f}, {0.1f, 0, -0.1f}, far, far + 0.1f, far + 0.2f},
                               {0, 1, 2, 3, 4, 5}),
                {0.3, 0.0, -0.2});
    EXPECT_LE(place_of(lamp).y, 2.0 * shadow::kClearOfPlanes * kReach_m);
    EXPECT_GE(place_of(lamp).y, shadow::kClearOfPlanes * kReach_m);
}

/// Checks that, between sheets nearer to each other than floats resolve, places stay between them.
TEST_P(LampPlacesTest, GoThroughNoSheetThatIsNear) {
    scene.place_floor(10.0);
    const double gap_m = 0.5 * kClear_m;
    scene.place_floor(10.0).translation_ws_m.y = gap_m;
    const glm::dvec3 place = place_of(scene.lamp({0.3, 1e-9, -0.2}));
    EXPECT_GT(place.y, 0.1 * gap_m);
    EXPECT_LT(place.y, 0.9 * gap_m);
}

/// Checks a sheet of two faces, back to back: the first face decides which side is before it.
TEST_P(LampPlacesTest, AreOnOneSideOfASheetWithTwoFaces) {
    scene.place_floor(10.0);
    scene.place(0, {0, 0, 0}, glm::dmat3({10, 0, 0}, {0, 0, 10}, {0, -10, 0}));
    EXPECT_GE(place_of(scene.lamp({0.3, 0.0, -0.2})).y, kClear_m);
}

TEST_P(LampPlacesTest, FollowWhatTheLampTouchesAndTheLamp) {
    scene.place_floor(10.0);
    finish();
    gl::RecordingDevice device;
    auto gpu = GpuScene::create(device, scene.library);
    ASSERT_TRUE(gpu);
    const LightItem lamp = scene.lamp({0.3, 0.0, -0.2});
    const glm::dvec3 above = place_of(lamp, gpu.value());
    EXPECT_EQ(place_of(lamp, gpu.value()), above);
    scene.snapshot.instances[0].translation_ws_m.y = 1e-9;
    finish();
    EXPECT_LT(place_of(lamp, gpu.value()).y, -kClear_m) << "the floor rose";
    EXPECT_GT(place_of(scene.lamp({0.3, 2e-9, -0.2}), gpu.value()).y, kClear_m) << "the lamp rose";
}

}  // namespace
}  // namespace gnomon::test
