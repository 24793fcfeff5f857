#include "tests/system/frame_fixture.h"

/// Surfaces are drawn as they lie before the camera, so that those behind are not shaded.
namespace gnomon {
namespace {

using ::testing::ElementsAre;

constexpr glm::dvec3 kBefore{0.0, 2.0, 9.0}, kBehind{0.0, 2.0, -9.0}, kAtAll{0.0, 1.0, 0.0};

class SurfaceOrder : public FrameTest {
protected:
    ecs::Entity add_box(const glm::dvec3& at_m) { return world.add_mesh(kBox, at_m, true); }
    void draw(const char* group = "surfaces") {
        step();
        drawn_.clear();
        for (const Pass& pass : passes())
            if (pass.group == group) drawn_ = drawn_slots(pass, "surface draw items");
    }
    std::vector<std::uint32_t> drawn_;  // slots, by the surfaces' pass
};

TEST_F(SurfaceOrder, IsThatOfTheirDistanceWithWhatReachesFarLast) {
    const ecs::Entity plane = world.add_mesh(kPlane, {0.0, 0.0, 0.0}, false);
    const ecs::Entity last = add_box({0.0, 1.0, -4.0}), middle = add_box({0.5, 1.0, 0.0}),
                      first = add_box({0.0, 1.0, 4.0});
    const ecs::Entity camera = world.add_camera(kBefore, kAtAll);
    draw();
    EXPECT_THAT(drawn_, ElementsAre(slot_of(first), slot_of(middle), slot_of(last), slot_of(plane)));
    world.registry.destroy(camera);
    world.add_camera(kBehind, kAtAll);
    draw();
    EXPECT_THAT(drawn_, ElementsAre(slot_of(last), slot_of(middle), slot_of(first), slot_of(plane)));
}

TEST_F(SurfaceOrder, OfDifferentMeshesIsThatOfTheirNearestInstances) {
    const ecs::Entity far_box = add_box({0.0, 1.0, -4.0});
    const ecs::Entity solid = world.add_mesh(kSolidBox, {0.0, 1.0, 2.0}, true);
    const ecs::Entity near_box = add_box({1.0, 1.0, 4.0});
    world.add_camera(kBefore, kAtAll);
    draw();
    EXPECT_THAT(drawn_, ElementsAre(slot_of(near_box), slot_of(far_box), slot_of(solid)))
        << "one draw holds all instances of a mesh";
}

TEST_F(SurfaceOrder, OfEqualsIsThatOfTheirEntities) {
    const ecs::Entity one = add_box({-1.0, 1.0, 0.0}), two = add_box({1.0, 1.0, 0.0});
    world.add_camera(kBefore, kAtAll);
    draw();
    EXPECT_THAT(drawn_, ElementsAre(slot_of(one), slot_of(two)));
}

TEST_F(SurfaceOrder, OfBlendedOnesIsTheOppositeByTheirMiddles) {
    const ecs::Entity middle = world.add_mesh(kBlendedBox, {0.5, 1.0, 0.0}, true);
    const ecs::Entity near_box = world.add_mesh(kBlendedBox, {0.0, 1.0, 4.0}, true);
    const ecs::Entity far_box = world.add_mesh(kBlendedBox, {0.0, 1.0, -4.0}, true);
    // Its middle is nearer than the far box's, its end farther off.
    const ecs::Entity large = world.add_mesh(kBlendedBox, {0.0, 1.0, -2.0}, true);
    world.registry.patch<Transform>(large, [](Transform& t) { t.scale = glm::dvec3(12.0); });
    const ecs::Entity camera = world.add_camera(kBefore, kAtAll);
    draw("blended");
    EXPECT_THAT(drawn_, ElementsAre(slot_of(far_box), slot_of(large), slot_of(middle), slot_of(near_box)));
    world.registry.destroy(camera);
    world.add_camera(kBehind, kAtAll);
    draw("blended");
    EXPECT_THAT(drawn_, ElementsAre(slot_of(near_box), slot_of(middle), slot_of(large), slot_of(far_box)));
}

}  // namespace
}  // namespace gnomon
