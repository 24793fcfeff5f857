#include "systems/shadow/fitting/fit_light.h"

#include <gtest/gtest.h>

#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/unit/shadow/in_map.h"
#include "tests/unit/shadow/random_scene.h"

namespace gnomon::shadow {
namespace {

/// Map coordinates and depth as the shaders compute them: float matrix, float offset from the anchor.
class FitTest : public ::testing::TestWithParam<LightKind> {
protected:
    /// Returns the view that the point is looked up in, or nullptr. Its map contains the point with the filter's
    /// margin, except on a cube's face. Among faces around a local light, only the face that looks most nearly toward
    /// the point counts.
    const ShadowView* view_of(const ShadowFrame& frame, const SceneSnapshot& scene, const glm::dvec3& p) const {
        const double margin = static_cast<double>(filter_settings(scene.lights[0], 512).widest_texel) /
                              scene.lights[0].shadow.resolution_px;
        double deepest = 0.0;
        if (GetParam() != LightKind::directional)
            for (const ShadowView& view : frame.fitted.views)
                deepest = std::max(deepest, glm::dot(apex_ws_m(view) - p, view.pose.axis_back));
        for (const ShadowView& view : frame.fitted.views) {
            const double keep = GetParam() == LightKind::point ? -1e-6 : margin;
            const glm::dvec3 q = in_map(view, p);
            const double ahead = glm::dot(apex_ws_m(view) - p, view.pose.axis_back);
            const bool before = GetParam() == LightKind::directional || (ahead > 0.0 && ahead == deepest);
            if (before && q.x >= keep && q.y >= keep && q.x <= 1.0 - keep && q.y <= 1.0 - keep && q.z >= 0.0 && q.z <= 1.0)
                return &view;
        }
        return nullptr;
    }
    template <class Visit>
    void for_each_point(RandomScene& random, const SceneSnapshot& scene, Visit visit) {
        for (const InstanceItem& receiver : scene.instances)
            for (int k = 0; k < 10; ++k) {
                const glm::dvec3 p = random_point(random, receiver.bounds_ws);
                if (receiver.visible && receiver.receives && seen(scene.consumers[0], p) && reaches(scene.lights[0], p)) visit(p);
            }
    }
};

TEST_P(FitTest, EveryVisiblePointLiesInAMapWithRoomForTheFilterAndItsBlockersBeforeIt) {
    RandomScene random(print_seed());
    int points = 0, blockers = 0;
    for (int round = 0; round < 150; ++round) {
        const SceneSnapshot scene = random.scene(GetParam());
        const ShadowFrame frame = fitted(scene);
        if (frame.fitted.views.empty()) continue;
        for_each_point(random, scene, [&](const glm::dvec3& p) {
            ++points;
            const ShadowView* view = view_of(frame, scene, p);
            const double depth = view ? in_map(*view, p).z : 0.0;
            for (const InstanceItem& caster : scene.instances) {
                const glm::dvec3 source = source_of(scene.lights[0], p);
                const Crossing hit = crossing(caster.bounds_ws, p, source);
                if (!caster.casts || !(hit.from < hit.to)) continue;
                ++blockers;
                ASSERT_NE(view, nullptr) << "round " << round << ": something is between the point and the light";
                const glm::dvec3 blocker = p + (source - p) * (0.5 * (hit.from + hit.to));
                const double its = GetParam() == LightKind::directional || hit.to < 1.0 ? in_map(*view, blocker).z : 1.0;
                // The matrix is of floats, which do not resolve a blocker that all but touches the point.
                EXPECT_GE(its, depth - 0x1p-24)
                    << "reversed: nearer is greater; beyond 1 it is clamped and still nearer";
                EXPECT_TRUE(std::isfinite(its));
            }
        });
    }
    EXPECT_GT(points, 500);
    EXPECT_GT(blockers, 100);
}

TEST_P(FitTest, AShiftedMapIsNoticed) {
    RandomScene random(7);
    const SceneSnapshot scene = random.scene(GetParam());
    ShadowFrame frame = fitted(scene);
    if (frame.fitted.views.empty()) GTEST_SKIP() << "this seed shows nothing to this kind";
    for (ShadowView& view : frame.fitted.views)  // shifted by a map's width
        for (int c = 0; c < 4; ++c) view.map_from_anchor[c][0] += view.map_from_anchor[c][3];
    bool outside = false;
    for_each_point(random, scene, [&](const glm::dvec3& p) { outside = outside || view_of(frame, scene, p) == nullptr; });
    EXPECT_TRUE(outside);
}

TEST_P(FitTest, TexelSizesAreThoseOfTheMap) {
    RandomScene random(print_seed());
    for (int round = 0; round < 60; ++round) {
        const SceneSnapshot scene = random.scene(GetParam());
        const double size_px = scene.lights[0].shadow.resolution_px;
        for (const ShadowView& view : fitted(scene).fitted.views) {
            const bool flat = view.projection == ViewProjection::orthographic;
            const double distance_m = flat ? 0.5 * (view.depth.near_m + view.depth.far_m) : view.depth.far_m;
            const glm::dvec3 p = apex_ws_m(view) - view.pose.axis_back * distance_m +
                                 (flat ? view.pose.axis_u * view.plane.centre_ls_m.x + view.pose.axis_v * view.plane.centre_ls_m.y
                                       : distance_m * 0.5 * (view.pose.axis_u * (view.plane.tan_low.x + view.plane.tan_high.x) +
                                                             view.pose.axis_v * (view.plane.tan_low.y + view.plane.tan_high.y)));
            const double unit = flat ? 1.0 : distance_m;
            // A perspective view's matrix is float: its rounding grows with how far the map lies off its axis, in maps.
            const glm::dvec2 off = flat ? glm::dvec2(0.0)
                                        : glm::max(glm::abs(view.plane.tan_low), glm::abs(view.plane.tan_high)) /
                                              (view.plane.tan_high - view.plane.tan_low);
            const double slack = 1e-5 * (1.0 + std::max(off.x, off.y));
            const glm::dvec3 at = in_map(view, p), right = in_map(view, p + 100.0 * unit * view.plane.texel_u * view.pose.axis_u),
                             up = in_map(view, p + 100.0 * unit * view.plane.texel_v * view.pose.axis_v);
            EXPECT_NEAR(at.x, 0.5, slack);
            EXPECT_NEAR(at.y, 0.5, slack);
            EXPECT_NEAR((right.x - at.x) * size_px, 100.0, 1e-2);
            EXPECT_NEAR((up.y - at.y) * size_px, 100.0, 1e-2);
            EXPECT_NEAR(right.y, at.y, slack);
            EXPECT_NEAR(up.x, at.x, slack);
            EXPECT_LT(view.depth.near_m, view.depth.far_m);
            if (!flat) {
                EXPECT_NEAR(at.z, view.depth.alpha + view.depth.beta / distance_m, 1e-6 * (1.0 + std::abs(view.depth.alpha)));
            }
        }
    }
}

TEST_P(FitTest, LayersAreCountedUpAndEveryViewNamesItsDemand) {
    RandomScene random(print_seed());
    for (int round = 0; round < 60; ++round) {
        const ShadowFrame frame = fitted(random.scene(GetParam()));
        for (std::uint32_t v = 0; v < frame.fitted.views.size(); ++v) {
            if (v > 0) {
                EXPECT_GT(frame.fitted.views[v].layer, frame.fitted.views[v - 1].layer);
            }
            EXPECT_LT(frame.fitted.views[v].layer, std::max(frame.fitted.lights[0].request.map.view_count, light_kind_row(GetParam()).layers));
            EXPECT_EQ(frame.fitted.views[v].light, 0u);
            EXPECT_TRUE(std::isfinite(frame.fitted.views[v].error.texel_edge_px));
        }
        EXPECT_LE(frame.fitted.views.size(), frame.fitted.lights[0].request.map.view_count);
    }
}

TEST_P(FitTest, TwiceTheTexelsHalveThePredictedErrorBeyondThePixelItself) {
    RandomScene random(11);
    SceneSnapshot scene = random.scene(GetParam());
    scene.lights[0].range_m = 0.0;
    scene.lights[0].position_ws_m = {0.0, 20.0, 0.0};
    scene.lights[0].rotation_ws = math::basis_from_back({0.0, 1.0, 0.0});
    scene.lights[0].shadow.filter = ShadowFilter::hard;
    const auto error = [&](std::uint32_t px) {
        scene.lights[0].shadow.resolution_px = px;
        const ShadowFrame frame = fitted(scene);
        return frame.fitted.views.empty() ? 0.0 : frame.fitted.views[0].error.texel_edge_px - 1.0;
    };
    ASSERT_GT(error(1024), 0.0);
    EXPECT_NEAR(error(1024) / error(2048), 2.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(EachKind, FitTest, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& param) { return std::string(light_kind_row(param.param).name); });

}  // namespace
}  // namespace gnomon::shadow
