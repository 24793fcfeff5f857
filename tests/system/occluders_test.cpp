#include <glm/gtc/quaternion.hpp>

#include "tests/system/frame_fixture.h"
#include "tests/system/silent_device.h"
#include "tests/unit/allocation_counter.h"

/// Houses in a whole frame: lamps behind one have no map and no pass, and a sun that turns draws what is before it.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::Not;

glm::dquat turned_to(const glm::dvec3& along) {
    return glm::quatLookAt(glm::normalize(along), glm::dvec3(0.0, 1.0, 0.0));
}

class HousesOfFrames : public FrameTest {
protected:
    void SetUp() override {
        assets::complete(library.meshes[kSolidBox]);
        FrameTest::SetUp();
        const ecs::Entity house = world.add_mesh(kSolidBox, {0, 0, 0}, true);
        world.registry.patch<Transform>(house, [](Transform& t) { t.scale = {8.0, 6.0, 2.0}; });
        for (int i = -6; i <= 6; ++i)
            for (const double z : {6.0, -6.0}) {
                const ecs::Entity slab = world.add_mesh(kSolidBox, {i * 1.0, 0, z}, false);
                world.registry.patch<Transform>(slab, [](Transform& t) { t.scale = {1.0, 0.1, 1.0}; });
            }
        for (int i = -4; i <= 4; ++i) world.add_mesh(kSolidBox, {i * 1.0, 0.6, -6.0}, true);
        for (int i = -2; i <= 2; ++i) world.add_mesh(kSolidBox, {i * 2.0, 0.6, 6.0}, true);
        world.add_camera({0, 1.5, 14}, {0, 1.5, 0});
        lamp = world.add_light(LightKind::spot, {0, 4, -6}, "behind");
        world.registry.patch<Transform>(lamp, [](Transform& t) {
            t.rotation = {0.70710678118654752, -0.70710678118654752, 0, 0};  // straight down
        });
        world.registry.patch<Light>(
            lamp, [](Light& l) { l.range_m = 5.0f, l.outer_cone_rad = 0.4f, l.inner_cone_rad = 0.3f; });
        sun = world.add_light(LightKind::directional, {1.0, 6.0, 3.0}, "sun");
    }
    void turn(int frame) {
        world.registry.patch<Transform>(sun, [frame](Transform& t) {
            t.rotation = turned_to({-1.0 - 0.001 * frame, -6.0, -3.0});
        });
    }
    ecs::Entity lamp, sun;
    int angle = 0;
};

TEST_F(HousesOfFrames, HideALampWithItsMapAndItsPass) {
    step();
    EXPECT_EQ(light("behind").reason, Reason::no_visible_receiver);
    EXPECT_EQ(light("behind").counts.bytes, 0u);
    const auto groups = [&] {
        std::vector<std::string> found;
        for (const Pass& pass : passes()) found.push_back(pass.group);
        return found;
    };
    EXPECT_THAT(groups(), Not(Contains("behind")));
    EXPECT_THAT(groups(), Contains("sun"));
    // Control: from above the house it is seen.
    world.registry.each<Camera>([&](ecs::Entity e, const Camera&) {
        world.registry.patch<Transform>(e, [](Transform& t) {
            t.translation_m = {0.0, 14.0, 10.0};
            t.rotation = turned_to({0.0, -14.0, -14.0});
        });
    });
    step();
    EXPECT_EQ(light("behind").reason, Reason::none);
    EXPECT_GT(light("behind").counts.bytes, 0u);
    EXPECT_THAT(groups(), Contains("behind"));
}

TEST_F(HousesOfFrames, ShortenTheListOfASunFromTheSecondFrameOnInWhichItTurns) {
    std::vector<std::uint64_t> triangles;
    for (const int angle : {0, 1, 2, 3, 3, 4, 5}) {
        turn(angle);
        step();
        triangles.push_back(light("sun").counts.triangles);
    }
    const std::uint64_t all = triangles[0];
    ASSERT_GT(all, 0u);
    EXPECT_EQ(triangles[1], all) << "it has turned once";
    EXPECT_LT(triangles[2], all);
    EXPECT_EQ(triangles[3], triangles[2]);
    EXPECT_EQ(triangles[4], 0u) << "nothing changed";
    EXPECT_EQ(triangles[5], triangles[2]) << "it goes on";
    EXPECT_EQ(triangles[6], triangles[2]);
}

TEST_F(HousesOfFrames, LeaveASunItsListThatLooksFartherAroundReceivers) {
    const auto listed = [&](const auto& change) {
        world.registry.patch<LightShadow>(sun, [&](LightShadow& s) { change(s); });
        std::uint64_t most = 0;
        for (int i = 0; i < 4; ++i) {
            turn(++angle);
            step();
            most = light("sun").counts.triangles;
        }
        return most;
    };
    const std::uint64_t few = listed([](LightShadow& s) { s.filter = ShadowFilter::triangles; });
    EXPECT_GT(listed([](LightShadow& s) { s.antialias = true; }), few);
    EXPECT_EQ(listed([](LightShadow& s) { s.antialias = false; }), few);
    world.registry.patch<Light>(sun, [](Light& l) { l.sun_radius_rad = 0.01f; });
    EXPECT_GT(listed([](LightShadow& s) { s.filter = ShadowFilter::pcss; }), few);
}

TEST_F(HousesOfFrames, DrawASunAgainWithAllWhenItStopsAndTheCameraWalks) {
    for (int angle = 0; angle < 4; ++angle) {
        turn(angle);
        step();
    }
    const std::uint64_t few = light("sun").counts.triangles;
    const auto walk = [&](double to_m) {
        world.registry.each<Camera>([&](ecs::Entity e, const Camera&) { world.move(e, {to_m, 1.5, 14.0}); });
        step();
        return light("sun").counts.triangles;
    };
    EXPECT_GT(walk(0.01), few);
    EXPECT_EQ(walk(0.02), 0u) << "the map stays while the camera walks";
    EXPECT_EQ(walk(0.03), 0u);
}

TEST_F(HousesOfFrames, AllocateNothingOnceWarm) {
    SilentDevice silent;
    auto made = FrameSystem::create(silent, library);
    ASSERT_TRUE(made);
    std::size_t allocations = 0;
    for (int i = 0; i < 12; ++i) {
        turn(i);
        const std::size_t before = allocation_count();
        made.value()->run(world.registry, settings);
        allocations = allocation_count() - before;
    }
    EXPECT_EQ(allocations, 0u);
}

}  // namespace
}  // namespace gnomon
