#include "tests/system/frame_fixture.h"

/// FrameSettings::freeze_fits: the stages go on for the cameras as they were, the picture for the cameras as they are.
namespace gnomon {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class FrozenFits : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        const ecs::Entity sun = world.add_light(LightKind::directional, kLightPlace_m, "sun");
        edit_light(world.registry, sun, [](ShadowTuning& t) { t.cascades.fit = ShadowFit::tight; });
        world.add_light(LightKind::spot, kLightPlace_m, "lamp");
        world.look_lights_up();
        step();
        step();
        camera_x_m = frame->snapshot().consumers.front().position_ws_m.x;
    }
    void move_camera(double by_m) {
        world.registry.patch<Transform>(stage.camera, [&](Transform& t) { t.translation_m.x += by_m; });
    }
    TestWorld::Stage stage;
    double camera_x_m = 0.0;
};

TEST_F(FrozenFits, ForAStillCameraEveryCommandStaysTheSame) {
    const gl::CommandList plain = frame->commands();
    settings.freeze_fits = true;
    for (int i = 0; i < 3; ++i) {
        step();
        EXPECT_EQ(frame->commands(), plain);
    }
}

TEST_F(FrozenFits, AMovedCameraDrawsItsPictureAndNoMap) {
    settings.freeze_fits = true;
    step();
    const gl::CommandList still = frame->commands();
    move_camera(1.5);
    step();
    EXPECT_THAT(depth_passes(), IsEmpty());
    EXPECT_NE(frame->commands(), still) << "the picture's camera did not move";
    EXPECT_EQ(frame->snapshot().consumers.front().position_ws_m.x, camera_x_m + 1.5);
    settings.freeze_fits = false;
    step();
    EXPECT_THAT(depth_passes(), ::testing::Not(IsEmpty())) << "thawed, the sun is fitted to the new place";
}

TEST_F(FrozenFits, FreezingAnewTakesTheCameraAsItIsThen) {
    settings.freeze_fits = true;
    step();
    move_camera(1.5);
    settings.freeze_fits = false;
    step();
    step();
    const gl::CommandList plain = frame->commands();
    settings.freeze_fits = true;
    step();
    EXPECT_EQ(frame->commands(), plain);
}

TEST_F(FrozenFits, WithoutAnyCameraNothingIsFrozenAndNothingBreaks) {
    settings.freeze_fits = true;
    step();
    world.registry.patch<Camera>(stage.camera, [](Camera& c) { c.active = false; });
    step();
    EXPECT_FALSE(frame->picture_target());
    world.registry.patch<Camera>(stage.camera, [](Camera& c) { c.active = true; });
    step();
    EXPECT_TRUE(frame->picture_target());
}

TEST_F(FrozenFits, OneOfTwoCamerasThatGoesLeavesTheOther) {
    world.add_camera({3.0, 4.0, 5.0}, {0.0, 0.0, 0.0});
    step();
    settings.freeze_fits = true;
    step();
    world.registry.destroy(stage.camera);
    step();
    EXPECT_TRUE(frame->picture_target());
    EXPECT_THAT(frame->snapshot().consumers, SizeIs(1));
    EXPECT_THAT(frame->snapshot().pictures, IsEmpty());
}

}  // namespace
}  // namespace gnomon
