#include "tests/system/frame_fixture.h"

/// What ShadowTuning::projection, the eye and the depth range do to maps, commands and report.
namespace gnomon {
namespace {

using ::testing::SizeIs;

class ProjectionReport : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        world.add_stage();
    }
    template <class Change>
    void change(ecs::Entity lamp, Change edit) {
        edit_light(world.registry, lamp, edit);
    }
};

TEST_F(ProjectionReport, ASunInPerspectiveHasAMapOfOneLayerAndDrawsItOnce) {
    const ecs::Entity sun = world.add_light(LightKind::directional, kLightPlace_m, "sun");
    change(sun, [](LightShadow& s) { s.cascades = 4; });
    step();
    ASSERT_THAT(map_labels(device), SizeIs(1 + 4));
    change(sun, [](ShadowTuning& t) { t.projection.kind = LightProjection::perspective; });
    step();
    EXPECT_THAT(map_labels(device), SizeIs(1 + 1));
    EXPECT_THAT(depth_passes(), SizeIs(1));
    EXPECT_EQ(light("sun").state, LightState::rendered);
    EXPECT_EQ(light("sun").counts.views, 1u);
    step();
    EXPECT_EQ(light("sun").state, LightState::reused);
    change(sun, [](ShadowTuning& t) { t.projection.kind = LightProjection::automatic; });
    step();
    EXPECT_THAT(map_labels(device), SizeIs(1 + 4));
    EXPECT_THAT(depth_passes(), SizeIs(4));
}

TEST_F(ProjectionReport, WhatAKindCannotDoIsReportedAndItsOwnIsDrawn) {
    for (const LightKind kind : {LightKind::spot, LightKind::point}) {
        const ecs::Entity lamp = world.add_light(kind, kLightPlace_m, "lamp");
        change(lamp, [](ShadowTuning& t) { t.projection.kind = LightProjection::orthographic; });
        step();
        EXPECT_EQ(light("lamp").state, LightState::degraded);
        EXPECT_STREQ(reason_code(light("lamp").reason), "projection_unsupported");
        EXPECT_GT(light("lamp").counts.draws, 0u);
        world.registry.destroy(lamp);
    }
}

TEST_F(ProjectionReport, AnAbsurdEyeOrRangeIsReported) {
    const ecs::Entity sun = world.add_light(LightKind::directional, kLightPlace_m, "sun");
    change(sun, [](LightShadow& s) { s.cascades = 4; });
    change(sun, [](ShadowTuning& t) { t.projection = {.kind = LightProjection::perspective, .eye_angle_rad = -1.0f}; });
    step();
    EXPECT_STREQ(reason_code(light("sun").reason), "eye_invalid");
    EXPECT_THAT(map_labels(device), SizeIs(1 + 4)) << "it stays orthographic";
    change(sun, [](ShadowTuning& t) {
        t.projection = {.kind = LightProjection::perspective, .eye_angle_rad = 1.0f, .near_m = 5.0f, .far_m = 1.0f};
    });
    step();
    EXPECT_STREQ(reason_code(light("sun").reason), "range_invalid");
    EXPECT_EQ(light("sun").counts.views, 1u);
}

}  // namespace
}  // namespace gnomon
