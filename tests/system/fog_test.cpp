#include <limits>

#include "gnomon/components.h"
#include "tests/system/frame_fixture.h"

/// Fog: the draws that it takes, the maps that it needs, and what it costs worlds without it.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class Fog : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        sun = world.add_light(LightKind::directional, kLightPlace_m, "sun");
        spot = world.add_light(LightKind::spot, kLightPlace_m, "spot");
    }
    ecs::Entity add_fog(const FogVolume& fog = {}, const glm::dvec3& at_m = {0.0, 2.0, 0.0}) {
        const ecs::Entity e = world.registry.create();
        world.registry.emplace<Transform>(e, {.translation_m = at_m});
        world.registry.emplace<FogVolume>(e, fog);
        return e;
    }
    std::vector<Pass> fog_passes() const {
        std::vector<Pass> of_fog = passes();
        std::erase_if(of_fog, [](const Pass& pass) { return pass.group != "fog"; });
        return of_fog;
    }

    TestWorld::Stage stage;
    ecs::Entity sun, spot;
};

TEST_F(Fog, TakesOfThePictureAndThenAddsEachLight) {
    add_fog();
    step();
    const std::vector<Pass> all = fog_passes();
    ASSERT_THAT(all, SizeIs(1));
    EXPECT_EQ(device.target(all[0].begin.target)->label, "light sum");
    EXPECT_FALSE(all[0].begin.clear_colour);
    ASSERT_THAT(all[0].pipelines, SizeIs(3)) << "the base, sun and spot";
    EXPECT_EQ(all[0].pipelines[0].blend, gl::Blend::alpha);
    EXPECT_EQ(all[0].pipelines[1].blend, gl::Blend::add);
    EXPECT_EQ(all[0].pipelines[2].blend, gl::Blend::add);
    for (const gl::PipelineState& state : all[0].pipelines) EXPECT_FALSE(state.depth_write);
    add_fog({}, {0.0, 2.0, -20.0});
    step();
    EXPECT_THAT(fog_passes().at(0).pipelines, SizeIs(6)) << "a base and two lights for each box";
}

TEST_F(Fog, CostsAWorldWithoutItNothing) {
    for (int i = 0; i < 40; ++i) step();
    const std::size_t commands = frame->commands().commands.size();
    EXPECT_THAT(compiled_labels(device), Each(Not(HasSubstr("fog"))));
    EXPECT_THAT(fog_passes(), IsEmpty());
    const ecs::Entity fog = add_fog();
    step();
    EXPECT_THAT(compiled_labels(device), Contains(HasSubstr("fog"))) << "control";
    world.registry.destroy(fog);
    for (int i = 0; i < 40; ++i) step();
    EXPECT_THAT(fog_passes(), IsEmpty());
    EXPECT_EQ(frame->commands().commands.size(), commands);
}

TEST_F(Fog, OutOfSightOrWithoutExtinctionDrawsNothing) {
    add_fog({}, {0.0, 0.0, 500.0});
    add_fog({.extinction_per_m = 0.0f});
    step();
    EXPECT_THAT(fog_passes(), IsEmpty());
    EXPECT_THAT(compiled_labels(device), Each(Not(HasSubstr("fog"))));
}

TEST_F(Fog, GivesALightMapsOfWhatDarkensAirAlone) {
    world.registry.patch<MeshRef>(stage.plane, [](MeshRef& m) { m.receives_shadow = false; });
    world.registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.receives_shadow = false; });
    step();
    EXPECT_EQ(light("spot").state, LightState::skipped) << "control";
    EXPECT_EQ(light("spot").reason, Reason::no_visible_receiver);
    const ecs::Entity fog = add_fog();
    step();
    EXPECT_EQ(light("spot").state, LightState::rendered);
    EXPECT_EQ(light("sun").state, LightState::rendered);
    EXPECT_EQ(light("spot").why.receivers, 1u);
    for (int i = 0; i < 40; ++i) step();
    EXPECT_EQ(light("spot").state, LightState::reused);
    EXPECT_TRUE(frame->report().still);
    // Elsewhere nothing darkens it.
    world.move(fog, {0.0, 2.0, -400.0});
    step();
    EXPECT_EQ(light("sun").reason, Reason::no_caster);
    world.move(fog, {0.0, 2.0, 0.0});
    world.registry.patch<FogVolume>(fog, [](FogVolume& f) { f.receives_shadow = false; });
    step();
    EXPECT_EQ(light("sun").reason, Reason::no_visible_receiver);
    world.registry.patch<FogVolume>(fog, [](FogVolume& f) { f.receives_shadow = true, f.shadow_layers = 2; });
    for (const ecs::Entity e : {sun, spot}) world.registry.patch<LightShadow>(e, [](LightShadow& s) { s.layers = 1; });
    step();
    EXPECT_EQ(light("sun").reason, Reason::no_visible_receiver) << "layers";
}

TEST_F(Fog, KeepsEveryLightHoweverDim) {
    world.registry.patch<Light>(spot, [](Light& l) { l.intensity = 1e-9f; });
    settings.exposure_ev = 14.0f;
    step();
    EXPECT_EQ(light("spot").reason, Reason::below_display_step) << "control";
    add_fog();
    step();
    EXPECT_NE(light("spot").reason, Reason::below_display_step);
}

TEST_F(Fog, OutOfRangeIsReportedAndDrawsNothing) {
    add_fog({.extinction_per_m = std::numeric_limits<float>::quiet_NaN()});
    step();
    ASSERT_THAT(frame->report().dropped, SizeIs(1));
    EXPECT_EQ(frame->report().dropped[0].reason, DropReason::absurd_fog);
    EXPECT_THAT(fog_passes(), IsEmpty());
}

TEST_F(Fog, FallsBackLikeAnyLookupWhereItsProgramFails) {
    step();
    device.fail_label("light in fog", gl::Failure::link_failed);
    add_fog();
    step();
    ASSERT_THAT(fog_passes(), SizeIs(1));
    EXPECT_THAT(fog_passes()[0].pipelines, SizeIs(1)) << "what it takes is drawn; no light has a program";
    EXPECT_EQ(light("spot").state, LightState::degraded);
}

}  // namespace
}  // namespace gnomon
