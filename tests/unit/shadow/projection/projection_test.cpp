#include <gtest/gtest.h>

#include <cmath>

#include "systems/shadow/projection/depth_range_override.h"
#include "systems/shadow/projection/sun_viewpoint.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/unit/not_finite.h"
#include "tests/unit/shadow/random_scene.h"

/// ShadowTuning::Projection, up to the views.
namespace gnomon::shadow {
namespace {

glm::dvec4 clip_of(const ShadowView& view, const glm::dvec3& p_ws) {
    return glm::dvec4(view.clip_from_anchor * glm::vec4(glm::vec3(p_ws - view.pose.anchor_ws_m), 1.0f));
}

TEST(Projection, APerspectiveSunHasOneViewFromItsEyeThatHoldsAllThatIsSeen) {
    RandomScene random(print_seed());
    int views = 0;
    for (int round = 0; round < 60; ++round) {
        SceneSnapshot scene = random.scene(LightKind::directional);
        scene.lights[0].tuning.projection.kind = LightProjection::perspective;
        scene.lights[0].tuning.projection.eye_angle_rad = static_cast<float>(random.number(0.05, 2.5));
        const ShadowFrame frame = fitted(scene);
        if (frame.fitted.views.empty()) continue;
        ASSERT_EQ(frame.fitted.views.size(), 1u);
        EXPECT_EQ(frame.fitted.lights[0].request.map.view_count, 1u);
        const ShadowView& view = frame.fitted.views[0];
        EXPECT_EQ(view.projection, ViewProjection::perspective);
        for (const glm::dvec3& p : frame.sets.receiver_points_ws) {
            const glm::dvec4 c = clip_of(view, p);
            EXPECT_GT(c.w, 0.0);
            EXPECT_LE(std::max(std::abs(c.x), std::abs(c.y)), c.w);
            EXPECT_GE(c.z, 0.0);
            EXPECT_LE(c.z, c.w);
            EXPECT_GT(glm::dot(view.pose.anchor_ws_m - p, scene.lights[0].rotation_ws[2]), 0.0)
                << "the eye stands toward the light";
            ++views;
        }
    }
    EXPECT_GT(views, 100);
}

TEST(Projection, TheEyeStandsAsFarFromTheMiddleAsIsAsked) {
    const glm::dmat3 basis = math::basis_from_back({0.0, 1.0, 0.0});
    const std::vector<glm::dvec3> seen = {{-3.0, 0.0, -4.0}, {3.0, 0.0, 4.0}, {1.0, 2.0, 0.0}};
    ShadowTuning::Projection tuning;
    tuning.eye_distance_m = 25.0f;
    EXPECT_LT(glm::distance(sun_viewpoint(basis, seen, tuning).position_ws_m, {0.0, 26.0, 0.0}), 1e-12);
    tuning.eye_distance_m = 0.0f;
    tuning.eye_angle_rad = 1.0471975512f;  // 60 degrees: twice the radius
    EXPECT_NEAR(sun_viewpoint(basis, seen, tuning).distance_m, 2.0 * std::sqrt(9.0 + 1.0 + 16.0), 1e-6);
}

TEST(Projection, WhatIsNoEyeIsNotTakenForOne) {
    EXPECT_TRUE(is_eye({}));
    EXPECT_TRUE(is_eye({.eye_distance_m = 1e9f, .eye_angle_rad = 2.7925268f}));
    for (const float bad : {-1.0f, kFloatNan, kFloatInfinity}) EXPECT_FALSE(is_eye({.eye_distance_m = bad})) << bad;
    for (const float bad : {0.0f, -1.0f, 2.8f, kFloatNan, kFloatInfinity}) EXPECT_FALSE(is_eye({.eye_angle_rad = bad})) << bad;
}

TEST(Projection, WhatIsNoRangeIsNotTakenForOne) {
    EXPECT_TRUE(is_range({}));
    EXPECT_TRUE(is_range({.near_m = 5.0f}));
    EXPECT_TRUE(is_range({.far_m = 1e-6f}));
    EXPECT_TRUE(is_range({.near_m = 1.0f, .far_m = 1.0001f}));
    for (const float bad : {-1.0f, kFloatNan, kFloatInfinity, -kFloatInfinity}) {
        EXPECT_FALSE(is_range({.near_m = bad})) << bad;
        EXPECT_FALSE(is_range({.far_m = bad})) << bad;
    }
    EXPECT_FALSE(is_range({.near_m = 2.0f, .far_m = 2.0f}));
    EXPECT_FALSE(is_range({.near_m = 3.0f, .far_m = 2.0f}));
}

TEST(Projection, AGivenEndReplacesTheFittedOneAndTheOtherMakesRoom) {
    const auto result = [](double near_m, double far_m) {
        double n = 10.0, f = 20.0;
        override_range(ProjectionRequest{.near_m = near_m, .far_m = far_m}, n, f);
        return std::pair(n, f);
    };
    EXPECT_EQ(result(0.0, 0.0), std::pair(10.0, 20.0));
    EXPECT_EQ(result(3.0, 0.0), std::pair(3.0, 20.0));
    EXPECT_EQ(result(0.0, 15.0), std::pair(10.0, 15.0));
    EXPECT_EQ(result(1.0, 2.0), std::pair(1.0, 2.0));
    EXPECT_EQ(result(40.0, 0.0), std::pair(40.0, 80.0));
    EXPECT_EQ(result(0.0, 4.0), std::pair(2.0, 4.0));
    const PerspectiveRange thin = overridden(ProjectionRequest{.near_m = 1e-30, .far_m = 1e8}, {10.0, 20.0});
    EXPECT_GT(thin.near_m, 1.0) << "D32F has to hold it";
    EXPECT_EQ(thin.far_m, 1e8);
}

class ProjectionOfKind : public ::testing::TestWithParam<LightKind> {};

TEST_P(ProjectionOfKind, AGivenRangeIsThatOfEveryView) {
    RandomScene random(print_seed());
    int views = 0;
    for (int round = 0; round < 30; ++round) {
        SceneSnapshot scene = random.scene(GetParam());
        ShadowTuning::Projection& tuning = scene.lights[0].tuning.projection;
        tuning.near_m = 2.0f;
        tuning.far_m = 30.0f;
        tuning.eye_distance_m = 20.0f;
        const ShadowFrame frame = fitted(scene);
        for (const ShadowView& view : frame.fitted.views) {
            EXPECT_NEAR(view.depth.far_m - view.depth.near_m, 28.0, 1e-9);
            glm::dvec3 from = scene.lights[0].position_ws_m;
            if (GetParam() == LightKind::directional)
                from = sun_viewpoint(math::basis_from_back(scene.lights[0].rotation_ws[2]), frame.sets.receiver_points_ws, tuning)
                           .position_ws_m;
            const glm::dvec4 start = clip_of(view, from - 2.0 * view.pose.axis_back),
                             end = clip_of(view, from - 30.0 * view.pose.axis_back);
            EXPECT_NEAR(start.z / start.w, 1.0, 1e-5);
            EXPECT_NEAR(end.z / end.w, 0.0, 1e-5);
            ++views;
        }
    }
    EXPECT_GT(views, 10);
}

TEST_P(ProjectionOfKind, AbsurdRangesChangeNoViewAndAreNoted) {
    RandomScene random(9);
    SceneSnapshot scene = random.scene(GetParam());
    const ShadowFrame plain = fitted(scene);
    ASSERT_FALSE(plain.fitted.views.empty());
    for (const auto& [near_m, far_m] :
         {std::pair(5.0f, 4.0f), {kFloatNan, 0.0f}, {0.0f, -1.0f}, {kFloatInfinity, 0.0f}, {2.0f, 2.0f}}) {
        scene.lights[0].tuning.projection.near_m = near_m;
        scene.lights[0].tuning.projection.far_m = far_m;
        const ShadowFrame frame = fitted(scene);
        EXPECT_EQ(frame.fitted.lights[0].request.note, Reason::range_invalid) << near_m << ", " << far_m;
        ASSERT_EQ(frame.fitted.views.size(), plain.fitted.views.size());
        for (std::size_t v = 0; v < frame.fitted.views.size(); ++v)
            EXPECT_EQ(frame.fitted.views[v].clip_from_anchor, plain.fitted.views[v].clip_from_anchor);
    }
    scene.lights[0].tuning.projection.near_m = 0.0f;
    scene.lights[0].tuning.projection.far_m = 0.5f;
    EXPECT_NE(fitted(scene).fitted.views[0].clip_from_anchor, plain.fitted.views[0].clip_from_anchor) << "a range that is one does";
}

TEST_P(ProjectionOfKind, ExtremeButUsableRangesGiveFiniteViews) {
    RandomScene random(9);
    SceneSnapshot scene = random.scene(GetParam());
    for (const auto& [near_m, far_m] :
         {std::pair(1e-38f, 0.0f), {0.0f, 1e-30f}, {1e-38f, 1e38f}, {0.0f, 1e38f}, {1e30f, 0.0f}}) {
        scene.lights[0].tuning.projection.near_m = near_m;
        scene.lights[0].tuning.projection.far_m = far_m;
        for (const ShadowView& view : fitted(scene).fitted.views)
            for (int c = 0; c < 4; ++c)
                for (int r = 0; r < 4; ++r)
                    EXPECT_TRUE(std::isfinite(view.clip_from_anchor[c][r])) << near_m << ", " << far_m;
    }
}

TEST_P(ProjectionOfKind, TheWishForAProjectionThatTheKindHasNotIsNotedAndItsOwnIsUsed) {
    RandomScene random(9);
    SceneSnapshot scene = random.scene(GetParam());
    const bool sun = GetParam() == LightKind::directional;
    const ShadowFrame plain = fitted(scene);
    scene.lights[0].tuning.projection.kind = LightProjection::orthographic;
    const ShadowFrame flat = fitted(scene);
    EXPECT_EQ(flat.fitted.lights[0].request.note, sun ? Reason::none : Reason::projection_unsupported);
    scene.lights[0].tuning.projection.kind = LightProjection::perspective;
    EXPECT_EQ(fitted(scene).fitted.lights[0].request.note, Reason::none);
    scene.lights[0].tuning.projection.eye_angle_rad = 3.0f;
    const ShadowFrame blind = fitted(scene);
    EXPECT_EQ(blind.fitted.lights[0].request.note, sun ? Reason::eye_invalid : Reason::none);
    for (const ShadowFrame* frame : {&flat, &blind}) {
        ASSERT_EQ(frame->fitted.views.size(), plain.fitted.views.size());
        for (std::size_t v = 0; v < plain.fitted.views.size(); ++v)
            EXPECT_EQ(frame->fitted.views[v].clip_from_anchor, plain.fitted.views[v].clip_from_anchor);
    }
}

INSTANTIATE_TEST_SUITE_P(EachKind, ProjectionOfKind,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& param) { return std::string(light_kind_row(param.param).name); });

}  // namespace
}  // namespace gnomon::shadow
