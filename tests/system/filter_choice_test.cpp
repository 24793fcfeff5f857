#include "systems/shadow/request/filter_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "systems/shadow/request/accuracy_target.h"
#include "tests/system/frame_fixture.h"
#include "tests/system/passes.h"

// The filter that a light's targets choose, frame by frame. The report names it, and it stays while a camera sways. It
// goes back to the usual one where that meets the targets again, and budgets come first.
namespace gnomon {
namespace {

constexpr ShadowFilter kUsual = shadow::kDefaultFilter, kKeeping = shadow::kExactFilter;
/// No map of a picture of 640 columns keeps the first from near by; any keeps the second from far away.
constexpr float kFine_px = 0.125f, kLoose_px = 1.0f;
const glm::dvec3 kNear_m{0.0, 4.0, 8.0}, kFar_m{0.0, 80.0, 160.0};

class ChosenFilter : public FrameTest, public ::testing::WithParamInterface<LightKind> {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        world.registry.patch<Camera>(stage.camera, [](Camera& c) { c.far_m = 1000.0f; });
        lamp = world.add_light(GetParam(), kLightPlace_m, "lamp");
    }
    void ask(const LightShadow& shadow) {
        world.registry.patch<LightShadow>(lamp, [&](LightShadow& s) { s = shadow; });
    }
    /// Runs a frame; counts how often the filter changed.
    ShadowFilter step_at(const glm::dvec3& camera_m) {
        world.move(stage.camera, camera_m);
        step();
        const ShadowFilter now = light("lamp").filter.filter;
        changes += last != ShadowFilter::automatic && last != now ? 1 : 0;
        return last = now;
    }
    TestWorld::Stage stage;
    ecs::Entity lamp;
    ShadowFilter last = ShadowFilter::automatic;
    int changes = 0;
};

TEST_P(ChosenFilter, KeepsAWordThatNoMapOfTheUsualOneKeepsAndSaysWhy) {
    ask({.filter = kUsual, .narrowest_caster_px = kFine_px});
    step_at(kNear_m);
    const double usual_px = light("lamp").resolved.px;
    EXPECT_FALSE(light("lamp").resolved.keeps_narrowest);
    EXPECT_EQ(light("lamp").filter.filter, kUsual) << "a filter that is named stays";
    EXPECT_EQ(light("lamp").filter.reason, Reason::none);
    EXPECT_FALSE(light("lamp").filter.usual_resolved_px);

    ask({.narrowest_caster_px = kFine_px});
    step_at(kNear_m);
    EXPECT_EQ(light("lamp").filter.filter, kKeeping) << "in the frame in which it is asked for";
    EXPECT_EQ(light("lamp").filter.reason, Reason::map_too_coarse);
    EXPECT_EQ(light("lamp").state, LightState::rendered);
    EXPECT_TRUE(light("lamp").resolved.keeps_narrowest);
    ASSERT_TRUE(light("lamp").filter.usual_resolved_px);
    EXPECT_NEAR(*light("lamp").filter.usual_resolved_px, usual_px, 0.2 * usual_px) << "fitted without what was held";
    EXPECT_THAT(map_labels(device, "ray "), ::testing::Not(::testing::IsEmpty()));

    ask({});
    step_at(kNear_m);
    EXPECT_EQ(light("lamp").filter.filter, kUsual) << "nothing is said";
    EXPECT_EQ(light("lamp").filter.reason, Reason::none);
}

TEST_P(ChosenFilter, KeepsAWordOfEdgesWithTheUsualOneWhereItsWalksDo) {
    for (const float wish_px : {64.0f, 1.0f, 0.7f}) {
        ask({.max_error_px = wish_px});
        step_at(kNear_m);
        EXPECT_EQ(light("lamp").filter.filter, kUsual) << wish_px;
        EXPECT_TRUE(light("lamp").keeps_max_error) << wish_px;
        EXPECT_GE(light("lamp").predicted_error_px, shadow::kWalk_px);
        EXPECT_LT(light("lamp").predicted_error_px, shadow::kWalk_px + 0.01);
        EXPECT_GT(light("lamp").resolved.px, 0.0);
        EXPECT_TRUE(light("lamp").resolved.keeps_narrowest) << "none is set";
    }
    ask({.max_error_px = 0.5f});
    step_at(kNear_m);
    EXPECT_EQ(light("lamp").filter.filter, kKeeping);
    ASSERT_TRUE(light("lamp").filter.usual_error_px);
    EXPECT_LT(*light("lamp").filter.usual_error_px, shadow::kWalk_px + 0.01);
    EXPECT_EQ(light("lamp").resolved.px, 0.0) << "rays resolve any caster";
    EXPECT_EQ(light("lamp").predicted_error_px, 0.0);
    EXPECT_TRUE(light("lamp").keeps_max_error);
}

TEST_P(ChosenFilter, SizesMapsByTheNarrowestCasterWhereOneIsNamed) {
    const auto texels = [&](const LightShadow& shadow) {
        ask({});
        world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.enabled = false; });
        step_at(kNear_m);
        ask(shadow);
        step_at(kNear_m);
        return light("lamp").counts.texels;
    };
    const std::uint64_t usual = texels({.filter = kUsual, .max_error_px = 1.0f});
    EXPECT_LT(texels({.filter = kUsual, .max_error_px = 1.0f, .narrowest_caster_px = 8.0f}), usual);
    EXPECT_LE(light("lamp").resolved.px, 8.0);
    EXPECT_TRUE(light("lamp").keeps_max_error);
    EXPECT_GE(texels({.filter = ShadowFilter::hard, .max_error_px = 1.0f, .narrowest_caster_px = 64.0f}), usual)
        << "texels decide its edges";
}

TEST_P(ChosenFilter, StaysTheUsualOneWhereItsMapsMeetTheTarget) {
    ask({.narrowest_caster_px = kLoose_px});
    step_at(kFar_m);
    EXPECT_EQ(light("lamp").filter.filter, kUsual);
    EXPECT_TRUE(light("lamp").resolved.keeps_narrowest);
    EXPECT_THAT(map_labels(device, "ray "), ::testing::IsEmpty());
}

TEST_P(ChosenFilter, IsHeldWhileTheCameraSwaysAndComesBackOnce) {
    ask({.narrowest_caster_px = kLoose_px});
    step_at(kFar_m);
    // The camera comes near until the target is just missed, then moves to and fro across that place.
    double times = 1.0;
    while (step_at(kFar_m * times) == kUsual && times > 0.01) times *= 0.97;
    ASSERT_EQ(last, kKeeping);
    ASSERT_EQ(changes, 1);
    for (int f = 0; f < 200; ++f) step_at(kFar_m * times * (1.0 + 0.04 * std::sin(0.9 * f)));
    EXPECT_EQ(changes, 1) << "it is held";
    EXPECT_TRUE(light("lamp").resolved.keeps_narrowest);
    for (std::uint32_t f = 0; f < 2 * shadow::kFilterFrames; ++f) step_at(kFar_m);
    EXPECT_EQ(last, kUsual);
    EXPECT_EQ(changes, 2);
    for (int f = 0; f < 100; ++f) step_at(kFar_m * (1.0 + 0.04 * std::sin(0.9 * f)));
    EXPECT_EQ(changes, 2);
    EXPECT_THAT(map_labels(device, "ray "), ::testing::IsEmpty());
}

TEST_P(ChosenFilter, ComesToRest) {
    ask({.narrowest_caster_px = kFine_px});
    for (std::uint32_t f = 0; f < 2 * shadow::kFilterFrames; ++f) step_at(kNear_m);
    EXPECT_EQ(last, kKeeping);
    EXPECT_TRUE(frame->report().still);
    EXPECT_EQ(light("lamp").counts.views_drawn, 0u);
    EXPECT_EQ(light("lamp").filter.reason, Reason::map_too_coarse) << "still";
}

TEST_P(ChosenFilter, IsTakenBackByABudgetOfRaysAndGivenAgain) {
    ask({.narrowest_caster_px = kFine_px});
    step_at(kNear_m);
    ASSERT_EQ(last, kKeeping);
    settings.shadow_budget.rays = 1;
    for (int f = 0; f < 200; ++f) {
        EXPECT_EQ(step_at(kNear_m * (1.0 + 0.04 * std::sin(0.9 * f))), kUsual) << f;
        EXPECT_EQ(light("lamp").reason, Reason::ray_budget);
        EXPECT_FALSE(light("lamp").resolved.keeps_narrowest);
    }
    settings.shadow_budget.rays = 0;
    step_at(kNear_m);
    EXPECT_EQ(step_at(kNear_m), kKeeping);
    EXPECT_EQ(changes, 2);
}

TEST_P(ChosenFilter, IsOfferedToABudgetBeforeItIsUsed) {
    settings.shadow_budget.rays = 1;
    ask({.narrowest_caster_px = kFine_px});
    for (int f = 0; f < 5; ++f) EXPECT_EQ(step_at(kNear_m), kUsual);
    EXPECT_THAT(map_labels(device, "ray "), ::testing::IsEmpty());
    EXPECT_EQ(light("lamp").reason, Reason::ray_budget);
}

TEST_P(ChosenFilter, KeepsWithinABudgetOfBytes) {
    ask({.narrowest_caster_px = kFine_px});
    step_at(kNear_m);
    const std::uint64_t all_bytes = light("lamp").counts.bytes;
    settings.shadow_budget.bytes = all_bytes / 10;
    const int before = changes;
    for (int f = 0; f < 200; ++f) {
        step_at(kNear_m * (1.0 + 0.01 * std::sin(0.9 * f)));
        EXPECT_LE(light("lamp").counts.bytes, settings.shadow_budget.bytes) << f;
    }
    EXPECT_LE(changes, before + 1);
    settings.shadow_budget.bytes = 0;
    step_at(kNear_m);
    EXPECT_EQ(step_at(kNear_m), kKeeping);
}

INSTANTIATE_TEST_SUITE_P(EachKind, ChosenFilter,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point));

}  // namespace
}  // namespace gnomon
