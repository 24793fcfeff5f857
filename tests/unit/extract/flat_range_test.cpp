#include "systems/extract/flat_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "systems/extract/volumes.h"
#include "tests/unit/extract/extracted_world.h"
#include "tests/unit/math/random_seed.h"

namespace gnomon {
namespace {

constexpr double kRange_m = 1.0e9;

InstanceItem box_at(const glm::dvec3& centre_m, const glm::dvec3& half_m) {
    InstanceItem item;
    item.bounds_ws = {centre_m - half_m, centre_m + half_m};
    return item;
}

/// Looks along -z from the origin, 8 m by 4 m.
ConsumerItem flat_camera() {
    ConsumerItem camera;
    camera.projection = CameraProjection::orthographic;
    camera.half_height_m = 2.0;
    camera.near_m = 0.0;
    camera.far_m = kRange_m;
    camera.viewport_px = {200, 100};
    return camera;
}

TEST(FlatRange, EndsWhereWhatIsSeenDoes) {
    SceneSnapshot scene;
    scene.instances = {box_at({0, 0, -10}, {1, 1, 1}), box_at({3, 0, -30}, {1, 1, 1})};
    const ViewRange range = flat_range(scene, flat_camera());
    EXPECT_LE(range.near_m, 9.0);
    EXPECT_GE(range.far_m, 31.0);
    EXPECT_LT(range.far_m - range.near_m, 1.25 * 22.0 + 1.0);
}

TEST(FlatRange, CountsNothingThatIsNotSeen) {
    SceneSnapshot scene;
    const ConsumerItem camera = flat_camera();
    scene.instances = {box_at({0, 0, -10}, {1, 1, 1})};
    const ViewRange alone = flat_range(scene, camera);
    scene.instances.push_back(box_at({0, 6, -5000}, {1, 1, 1}));
    scene.instances.push_back(box_at({0, 0, 5000}, {1, 1, 1}));
    EXPECT_EQ(flat_range(scene, camera), alone);
}

TEST(FlatRange, OfAnEndlessGroundIsThatOfItsSeenPart) {
    SceneSnapshot scene;
    scene.instances = {box_at({0, -1, 0}, {1.0e6, 0, 1.0e6})};
    ConsumerItem camera = flat_camera();
    camera.rotation_ws = glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0.8, -0.6), glm::dvec3(0, 0.6, 0.8));
    camera.position_ws_m = {0, 20, 0};
    const ViewRange range = flat_range(scene, camera);
    // The ray in the middle meets it after 21 / 0.6 = 35 m, those above and below 2 * 0.8 / 0.6 = 2.7 m beside that.
    EXPECT_NEAR(range.near_m, 32.3, 1.0);
    EXPECT_NEAR(range.far_m, 37.7, 1.0);
}

TEST(FlatRange, StaysAsGivenWhereNothingIsSeen) {
    SceneSnapshot scene;
    const ConsumerItem camera = flat_camera();
    const ViewRange given{camera.near_m, camera.far_m};
    EXPECT_EQ(flat_range(scene, camera), given);
    scene.instances = {box_at({0, 0, 10}, {1, 1, 1})};
    EXPECT_EQ(flat_range(scene, camera), given);
}

TEST(FlatRange, ShowsNoMoreThanWhatIsGiven) {
    SceneSnapshot scene;
    scene.instances = {box_at({0, 0, -10}, {1, 1, 100})};
    ConsumerItem camera = flat_camera();
    camera.near_m = -3.0;
    camera.far_m = 7.0;
    EXPECT_EQ(flat_range(scene, camera), (ViewRange{-3.0, 7.0}));
}

TEST(FlatRange, HoldsAWallAcrossTheView) {
    SceneSnapshot scene;
    scene.instances = {box_at({0, 0, -10}, {50, 50, 0})};
    const ViewRange range = flat_range(scene, flat_camera());
    EXPECT_LT(range.near_m, 10.0);
    EXPECT_GT(range.far_m, 10.0);
    EXPECT_LT(range.far_m - range.near_m, 2.0);
}

TEST(FlatRange, IsTheSameWhileThingsMoveALittle) {
    SceneSnapshot scene;
    scene.instances = {box_at({0, 0, -10}, {1, 1, 1}), box_at({0, 0, -40}, {1, 1, 1})};
    std::size_t changes = 0;
    ViewRange last = flat_range(scene, flat_camera());
    for (int frame = 0; frame < 100; ++frame) {
        scene.instances[1].bounds_ws.min.z -= 0.02;
        scene.instances[1].bounds_ws.max.z -= 0.02;
        const ViewRange now = flat_range(scene, flat_camera());
        changes += now != last;
        last = now;
    }
    EXPECT_LE(changes, 1u);
}

TEST(FlatRange, HoldsAllThatIsSeenOfRandomScenesAndLittleElse) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto any = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
    std::size_t seen = 0;
    for (int round = 0; round < 300; ++round) {
        SceneSnapshot scene;
        const double size_m = std::exp2(10.0 * unit(random));
        const glm::dvec3 origin_m = 1.0e4 * size_m * any();
        for (int i = 0; i < 20; ++i)
            scene.instances.push_back(box_at(origin_m + 10.0 * size_m * any(), size_m * glm::abs(any())));
        scene.version = 1;
        if (round % 2 == 0) build_tree(scene);
        ConsumerItem camera = flat_camera();
        camera.half_height_m = 3.0 * size_m;
        camera.position_ws_m = origin_m;
        camera.rotation_ws = math::basis_from_back(any());
        camera.near_m = -kRange_m;
        const ViewRange range = flat_range(scene, camera);
        double least_m = kRange_m, most_m = -kRange_m;
        for (const InstanceItem& item : scene.instances) {
            std::vector<glm::dvec3> corners;
            math::clip_box(consumer_frustum(camera), item.bounds_ws, corners);
            for (const glm::dvec3& corner : corners) {
                const double at_m = glm::dot(camera.rotation_ws[2], camera.position_ws_m - corner);
                least_m = std::min(least_m, at_m);
                most_m = std::max(most_m, at_m);
            }
        }
        if (most_m < least_m) continue;
        ++seen;
        EXPECT_LT(range.near_m, least_m);
        EXPECT_GT(range.far_m, most_m);
        EXPECT_LT(range.far_m - range.near_m,
                  1.3 * std::max(most_m - least_m, camera.half_height_m) + most_m - least_m);
    }
    EXPECT_GT(seen, 200u);
}

class FlatViews : public ExtractedWorldTest {
protected:
    FlatViews() { viewport_px = {100, 100}; }
    double far_m() const { return snapshot.consumers.at(0).far_m; }
};

TEST_F(FlatViews, FollowWhatMovesAndWhatThePictureHolds) {
    const ecs::Entity box = world.add_mesh(kBox, {0, 0, -10}, true);
    world.add_mesh(kBox, {7, 0, -90}, true);
    const ecs::Entity camera = world.add_camera({0, 0, 0}, {0, 0, -1});
    world.registry.patch<Camera>(camera, [](Camera& c) {
        c.projection = CameraProjection::orthographic;
        c.half_height_m = 5.0;
    });
    update();
    EXPECT_GT(far_m(), 10.5);
    EXPECT_LT(far_m(), 15.0);
    world.move(box, {0, 0, -40});
    update();
    EXPECT_GT(far_m(), 40.5);
    EXPECT_LT(far_m(), 45.0);
    viewport_px.x = 200;  // the other box comes into it
    update();
    EXPECT_GT(far_m(), 90.5);
    EXPECT_LT(far_m(), 110.0);
    world.registry.patch<Camera>(camera, [](Camera& c) { c.projection = CameraProjection::perspective; });
    update();
    EXPECT_EQ(far_m(), kRange_m);
}

TEST_F(FlatViews, HaveAllOfTheirRangeOnceNothingIsLeft) {
    const ecs::Entity box = world.add_mesh(kBox, {0, 0, -10}, true);
    const ecs::Entity camera = world.add_camera({0, 0, 0}, {0, 0, -1});
    world.registry.patch<Camera>(camera, [](Camera& c) { c.projection = CameraProjection::orthographic; });
    update();
    world.registry.destroy(box);
    viewport_px = {50, 50};
    update();
    EXPECT_EQ(far_m(), kRange_m);
    world.registry.destroy(camera);
    viewport_px = {100, 100};
    update();
    EXPECT_TRUE(snapshot.consumers.empty());
}

}  // namespace
}  // namespace gnomon
