#include <gtest/gtest.h>

#include <algorithm>

#include "systems/shadow/projection/lispsm_math.h"
#include "tests/unit/shadow/in_map.h"
#include "tests/unit/shadow/random_scene.h"

namespace gnomon::shadow {
namespace {

/// Makes a wide floor with a few boxes on it, seen by a camera that looks along it. The sun stands `angle_rad` from the
/// camera's view, turned about the horizon.
SceneSnapshot floor_scene(double angle_rad, float warp) {
    SceneSnapshot s;
    const auto add = [&](const glm::dvec3& low, const glm::dvec3& high) {
        InstanceItem item;
        item.gpu_slot = static_cast<std::uint32_t>(s.instances.size());
        item.bounds_ws = {low, high};
        item.casts = item.receives = item.visible = true;
        s.instances.push_back(item);
    };
    add({-40, -0.1, -80}, {40, 0, 0});
    add({3, 0, -12}, {4, 2, -11});
    add({-9, 0, -40}, {-7, 5, -37});
    ConsumerItem camera;
    camera.position_ws_m = {1.3, 3.0, 4.0};
    camera.rotation_ws = math::basis_from_back({0.05, 0.2, 1.0});
    camera.fov_y_rad = 0.9;
    camera.viewport_px = {640, 360};
    s.consumers.push_back(camera);
    LightItem light;
    light.kind = LightKind::directional;
    light.intensity = 1.0f;
    light.has_shadow = true;
    light.shadow.resolution_px = 1024;
    light.shadow.cascades = 1;
    light.tuning.cascades.fit = ShadowFit::tight;
    light.tuning.cascades.warp = warp;
    const glm::dvec3 along = -camera.rotation_ws[2], up = camera.rotation_ws[1];
    // The light's own turn about its axis must not matter, so that it may be any.
    light.rotation_ws = math::basis_from_back(along * std::cos(angle_rad) + up * std::sin(angle_rad));
    s.lights.push_back(light);
    return s;
}

/// Folds a place in the map, so that turns by quarters count as none: the unwarped fit makes them as well.
glm::dvec2 folded(const glm::dvec3& q) {
    const double x = std::abs(q.x - 0.5), y = std::abs(q.y - 0.5);
    return {std::min(x, y), std::max(x, y)};
}

/// Returns the largest distance, in maps, by which any seen point lies elsewhere in b than in a.
double farthest_move(const ShadowFrame& a, const ShadowFrame& b) {
    double worst = 0.0;
    for (const glm::dvec3& p : a.sets.receiver_points_ws) {
        const glm::dvec2 d = glm::abs(folded(in_map(a.fitted.views.at(0), p)) - folded(in_map(b.fitted.views.at(0), p)));
        worst = std::max({worst, d.x, d.y});
    }
    return worst;
}

TEST(WarpedFit, AcrossTheViewTexelsGrowWithTheDistanceFromTheCamera) {
    const ShadowFrame frame = fitted(floor_scene(1.5, 1.0f));
    ASSERT_EQ(frame.fitted.views.size(), 1u);
    EXPECT_GT(glm::length(frame.fitted.views[0].plane.warp), 0.0);
    const SceneSnapshot scene = floor_scene(1.5, 1.0f);
    const glm::dvec3 along = -scene.consumers[0].rotation_ws[2];
    const glm::dvec2 toward(glm::dot(along, frame.fitted.views[0].pose.axis_u), glm::dot(along, frame.fitted.views[0].pose.axis_v));
    EXPECT_GT(glm::dot(toward, frame.fitted.views[0].plane.warp), 0.0) << "w grows away from the camera";
}

TEST(WarpedFit, WhereTheLightShinesAlongTheViewThereIsNoWarpAndTheMapIsTheTightOne) {
    constexpr double kPi = 3.14159265358979;
    for (const double angle : {1e-9, 1e-7, kPi - 1e-7}) {
        const ShadowFrame warped = fitted(floor_scene(angle, 1.0f)), tight = fitted(floor_scene(angle, 0.0f));
        EXPECT_LT(farthest_move(warped, tight), 1e-5) << angle;
    }
}

TEST(WarpedFit, TheWarpChangesContinuouslyWhileTheLightTurnsThroughTheView) {
    // Halving the step halves the largest change of the warp: nothing switches.
    const auto largest_change = [](int steps) {
        double worst = 0.0, before = -1.0;
        for (int i = -steps; i <= steps; ++i) {
            const ShadowFrame frame = fitted(floor_scene(0.5 * i / steps, 1.0f));
            const ShadowView& v = frame.fitted.views.at(0);
            double most_w = 1.0;
            for (const glm::dvec3& p : frame.sets.receiver_points_ws) {
                const glm::dvec3 d = p - v.pose.anchor_ws_m;
                most_w = std::max(most_w, warp_w(v.plane.warp, {glm::dot(d, v.pose.axis_u), glm::dot(d, v.pose.axis_v)}));
            }
            if (before >= 0.0) worst = std::max(worst, std::abs(std::log(most_w) - before));
            before = std::log(most_w);
        }
        return worst;
    };
    const double coarse = largest_change(60), fine = largest_change(480);
    EXPECT_GT(coarse, 1e-3) << "nothing is warped";
    EXPECT_LT(fine, 0.3 * coarse + 1e-4) << coarse << " and " << fine;
}

TEST(WarpedFit, TheWorstTexelIsHardlyEverLargerThanWithoutAWarp) {
    RandomScene random(print_seed());
    int warped = 0, larger = 0;
    for (int i = 0; i < 400; ++i) {
        SceneSnapshot scene = random.scene(LightKind::directional);
        scene.lights[0].shadow.cascades = 1;
        scene.lights[0].tuning.cascades.fit = ShadowFit::tight;
        const ShadowFrame flat = fitted(scene);
        scene.lights[0].tuning.cascades.warp = 1.0f;
        const ShadowFrame frame = fitted(scene);
        if (frame.fitted.views.empty()) continue;
        warped += frame.fitted.views[0].plane.warp != glm::dvec2(0.0) ? 1 : 0;
        // What a view states counts the corners of its rectangle as well, which hold nothing.
        const double share = frame.fitted.views[0].error.extent_px / flat.fitted.views.at(0).error.extent_px;
        EXPECT_LE(share, 1.2) << i;
        larger += share > 1.05 ? 1 : 0;
    }
    EXPECT_LE(larger, 2);
    EXPECT_GT(warped, 40);
}

/// Fits a receiver so small that its corners round to one place beside the warp's anchor.
TEST(WarpedFit, OfASpeckIsTheTightOne) {
    const auto speck = [](float warp) {
        SceneSnapshot scene = floor_scene(1.5, warp);
        scene.instances.resize(1);
        scene.instances[0].bounds_ws = {{0.0, -1.0, -12.0}, {1e-24, -1.0, -12.0}};
        scene.lights[0].rotation_ws = math::basis_from_back({0.0, 1.0, 0.0});
        return scene;
    };
    const ShadowFrame warped = fitted(speck(1.0f)), tight = fitted(speck(0.0f));
    ASSERT_EQ(warped.fitted.views.size(), 1u);
    EXPECT_EQ(warped.fitted.views[0].map_from_anchor, tight.fitted.views.at(0).map_from_anchor);
    EXPECT_TRUE(std::isfinite(warped.fitted.views[0].map_from_anchor[0][0]));
}

TEST(WarpedFit, WhatCannotBeWarpedSaysSo) {
    SceneSnapshot scene = floor_scene(1.5, 1.0f);
    EXPECT_EQ(fitted(scene).fitted.lights[0].request.note, Reason::none);
    scene.lights[0].tuning.cascades.fit = ShadowFit::stable;
    EXPECT_EQ(fitted(scene).fitted.lights[0].request.note, Reason::warp_unsupported);
    EXPECT_EQ(fitted(scene).fitted.views.at(0).plane.warp, glm::dvec2(0.0));
    scene = floor_scene(1.5, 2.0f);
    EXPECT_EQ(fitted(scene).fitted.lights[0].request.note, Reason::warp_unsupported);
    scene = floor_scene(1.5, 1.0f);
    scene.consumers.push_back(scene.consumers[0]);
    EXPECT_EQ(fitted(scene).fitted.lights[0].request.note, Reason::warp_unsupported);
}

TEST(Warp, AStepOfTheWarpedPlaneIsTheInverseOfTheWarpsDerivative) {
    const glm::dvec2 gradient(0.03, -0.05), p(4.0, -7.0), step(1e-6, 2e-6);
    const glm::dvec2 there = unwarped(gradient, warped(gradient, p) + step);
    const glm::dvec2 expected = p + unwarped_step(gradient, p, step);
    EXPECT_NEAR(there.x, expected.x, 1e-10);
    EXPECT_NEAR(there.y, expected.y, 1e-10);
}

}  // namespace
}  // namespace gnomon::shadow
