#include "tests/system/frame_fixture.h"

/// A walking camera and a still world: which fits let a sun's maps be used again.
namespace gnomon {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class CascadeEconomy : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        sun = world.add_light(LightKind::directional, kLightPlace_m, "sun");
    }
    void use(ShadowFit fit) {
        edit_light(world.registry, sun, [fit](ShadowTuning& t) { t.cascades.fit = fit; });
    }
    void walk(double step_m) {
        world.registry.patch<Transform>(stage.camera, [step_m](Transform& t) { t.translation_m.x += step_m; });
    }
    /// Counts the views drawn over a walk, after the first frame.
    std::size_t drawn_on_a_walk(double step_m, int steps) {
        step();
        EXPECT_GT(light("sun").counts.views_drawn, 0u);
        std::size_t drawn = 0;
        for (int i = 0; i < steps; ++i) {
            walk(step_m);
            step();
            drawn += light("sun").counts.views_drawn;
        }
        return drawn;
    }
    TestWorld::Stage stage;
    ecs::Entity sun;
};

TEST_F(CascadeEconomy, ASmallStepDrawsNothingInModesThatHold) {
    for (const ShadowFit fit : {ShadowFit::stable, ShadowFit::quantised}) {
        use(fit);
        EXPECT_EQ(drawn_on_a_walk(1.0e-4, 1), 0u) << static_cast<int>(fit);
        EXPECT_EQ(light("sun").state, LightState::reused);
        EXPECT_STREQ(reason_code(light("sun").reason), "content_unchanged");
        EXPECT_EQ(light("sun").counts.draws, 0u);
        EXPECT_GT(light("sun").counts.views, 0u);
    }
}

TEST_F(CascadeEconomy, ATightFitDrawsAllOfThemAgain) {
    use(ShadowFit::tight);
    step();
    const std::uint32_t views = light("sun").counts.views_drawn;
    // Along the view, so that every slice begins elsewhere.
    world.registry.patch<Transform>(stage.camera, [](Transform& t) { t.translation_m.z += 1.0e-4; });
    step();
    EXPECT_THAT(depth_passes(), SizeIs(views));
    EXPECT_EQ(light("sun").state, LightState::rendered);
}

TEST_F(CascadeEconomy, ASecondOfWalkingDrawsAFractionOfWhatATightFitDraws) {
    constexpr int kSteps = 60;
    constexpr double kStep_m = 1.4 / 60.0;
    use(ShadowFit::tight);
    const std::size_t tight = drawn_on_a_walk(kStep_m, kSteps);
    for (const ShadowFit fit : {ShadowFit::stable, ShadowFit::quantised}) {
        use(fit);
        const std::size_t held = drawn_on_a_walk(-kStep_m, kSteps);
        EXPECT_LT(held * 2, tight) << static_cast<int>(fit);
    }
}

TEST_F(CascadeEconomy, AMapThatIsHeldIsDrawnAgainWhenACasterMoves) {
    for (const ShadowFit fit : {ShadowFit::stable, ShadowFit::quantised}) {
        use(fit);
        step();
        world.registry.patch<Transform>(stage.box, [](Transform& t) { t.translation_m.z += 0.01; });
        step();
        EXPECT_GT(light("sun").counts.views_drawn, 0u) << static_cast<int>(fit);
        step();
        EXPECT_THAT(depth_passes(), IsEmpty());
    }
}

TEST_F(CascadeEconomy, ACascadeThatNothingCanDarkenIsNeitherDrawnNorClearedNorLookedUp) {
    world.registry.patch<LightShadow>(sun, [](LightShadow& s) { s.cascades = 4; });
    // Ground far behind the box, which none of it darkens.
    for (const double z_m : {-40.0, -60.0, -80.0}) world.add_mesh(kPlane, {0, 0, z_m}, false);
    step();
    std::uint32_t lit = 0;
    for (const ViewReport& view : frame->report().views_of(light("sun"))) {
        if (view.reason != Reason::no_caster) continue;
        ++lit;
        EXPECT_EQ(view.state, LightState::skipped);
        EXPECT_GT(view.why.receivers, 0u);
        EXPECT_EQ(view.why.casters, 0u);
    }
    ASSERT_GT(lit, 0u);
    EXPECT_THAT(depth_passes(), SizeIs(light("sun").counts.views));
    EXPECT_EQ(light("sun").counts.clears, light("sun").counts.views);
    EXPECT_LE(light("sun").counts.views + lit, 4u);
    world.add_mesh(kBox, {0, 1, -60}, true);
    step();
    EXPECT_GT(depth_passes().size(), 0u) << "and with something there it is drawn";
    std::uint32_t still_lit = 0;
    for (const ViewReport& view : frame->report().views_of(light("sun"))) still_lit += view.reason == Reason::no_caster;
    EXPECT_LT(still_lit, lit);
}

TEST_F(CascadeEconomy, EightCascadesHaveEightLayersAndNineAreReported) {
    world.registry.patch<LightShadow>(sun, [](LightShadow& s) { s.cascades = 8; });
    step();
    EXPECT_THAT(map_labels(device), SizeIs(1 + 8));
    EXPECT_EQ(light("sun").reason, Reason::none);
    world.registry.patch<LightShadow>(sun, [](LightShadow& s) { s.cascades = 9; });
    step();
    EXPECT_THAT(map_labels(device), SizeIs(1 + 8));
    EXPECT_STREQ(reason_code(light("sun").reason), "cascades_clamped");
    edit_light(world.registry, sun, [](LightShadow& s) { s.cascades = 1; });
    edit_light(world.registry, sun, [](ShadowTuning& t) { t.cascades.blend = 2.0f; });
    step();
    EXPECT_THAT(map_labels(device), SizeIs(1 + 1));
    EXPECT_STREQ(reason_code(light("sun").reason), "splits_invalid");
}

}  // namespace
}  // namespace gnomon
