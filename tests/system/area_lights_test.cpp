#include <gmock/gmock.h>

#include "tests/system/frame_fixture.h"

/// What area lights cost, and what becomes of bad ones.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr LightKind kKinds[] = {LightKind::rectangle, LightKind::disc, LightKind::sphere, LightKind::tube};
constexpr const char* kTable = "area lights' lobes";

class AreaLightFrames : public FrameTest {
protected:
    ecs::Entity add_area(LightKind kind, bool shadow = true) {
        const ecs::Entity light = world.add_light(kind, kLightPlace_m, to_text(kind), shadow);
        world.registry.patch<Light>(light, [](Light& l) { l.source_radius_m = 0.2f; });
        return light;
    }
};

TEST_F(AreaLightFrames, HaveATableOnlyWhileASceneHasOne) {
    world.add_stage();
    world.add_light(LightKind::point, kLightPlace_m, "lamp");
    step();
    EXPECT_THAT(device.live_labels(), Not(Contains(kTable)));
    const ecs::Entity light = add_area(LightKind::rectangle, false);
    step();
    EXPECT_THAT(device.live_labels(), Contains(kTable).Times(1));
    world.registry.destroy(light);
    step();
    EXPECT_THAT(device.live_labels(), Not(Contains(kTable)));
}

TEST_F(AreaLightFrames, OfAllKindsShareATableAndHaveAProgramEach) {
    world.add_stage();
    for (const LightKind kind : kKinds) add_area(kind, false);
    step();
    EXPECT_THAT(device.live_labels(), Contains(kTable).Times(1));
    for (const char* define : {"LIGHT_RECTANGLE", "LIGHT_DISC", "LIGHT_SPHERE", "LIGHT_TUBE"})
        EXPECT_THAT(device.live_labels(), Contains(HasSubstr(define)).Times(1));
}

TEST_F(AreaLightFrames, WithoutRoomForTheTableGiveAReason) {
    world.add_stage();
    add_area(LightKind::disc, false);
    device.fail_label(kTable, gl::Failure::out_of_memory);
    step();
    EXPECT_NE(frame->report().failure, gl::Failure::none);
}

TEST_F(AreaLightFrames, WithoutASizeAreDroppedAndComeBackWithOne) {
    world.add_stage();
    for (const LightKind kind : kKinds) {
        const ecs::Entity light = add_area(kind);
        world.registry.patch<Light>(light, [](Light& l) { l.source_radius_m = l.height_m = 0.0f; });
        step();
        EXPECT_EQ(frame->snapshot().lights.size(), 0u) << to_text(kind);
        ASSERT_EQ(frame->snapshot().dropped.size(), 1u);
        EXPECT_EQ(frame->snapshot().dropped[0].reason, DropReason::absurd_light);
        world.registry.patch<Light>(light, [](Light& l) { l.source_radius_m = l.height_m = 0.2f; });
        step();
        EXPECT_EQ(frame->snapshot().lights.size(), 1u) << "the control";
        world.registry.destroy(light);
    }
}

}  // namespace
}  // namespace gnomon
