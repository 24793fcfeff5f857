#include "systems/shadow/fitting/error_bound.h"

#include <gtest/gtest.h>

#include <limits>

#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/unit/shadow/random_scene.h"

namespace gnomon::shadow {
namespace {

using Exact = long double;
using vec2x = glm::vec<2, Exact>;
using vec3x = glm::vec<3, Exact>;

/// Pixels, by the way the picture is made and no formula of the prediction.
vec2x pixel_of(const ConsumerItem& c, const vec3x& p_ws) {
    const vec3x d = p_ws - vec3x(c.position_ws_m);
    const auto along = [&](int axis) { return glm::dot(d, vec3x(c.rotation_ws[axis])); };
    const Exact half_y = std::tan(Exact{0.5} * static_cast<Exact>(c.fov_y_rad));
    return vec2x(along(0), along(1)) / -along(2) / (2 * half_y) * static_cast<Exact>(c.viewport_px.y);
}

/// Returns the point of the plane (p_ws, normal) that lies texel (du, dv) beside p_ws in the map.
vec3x beside(const ShadowView& view, const vec3x& p_ws, const vec3x& normal, Exact du, Exact dv) {
    const bool flat = view.projection == ViewProjection::orthographic;
    const vec3x anchor(apex_ws_m(view)), back(view.pose.axis_back);
    const Exact z_m = flat ? Exact{1} : glm::dot(anchor - p_ws, back);
    const vec3x shifted = p_ws + vec3x(view.pose.axis_u) * (du * static_cast<Exact>(view.plane.texel_u) * z_m) +
                          vec3x(view.pose.axis_v) * (dv * static_cast<Exact>(view.plane.texel_v) * z_m);
    const vec3x source = flat ? shifted + back : anchor;
    const vec3x ray = shifted - source;
    return source + ray * (glm::dot(p_ws - source, normal) / glm::dot(ray, normal));
}

/// Steeper receivers are not scored, either (tests/oracle/reference_tracer.h).
constexpr double kLeastFacing = 1e-4;

class PredictedError : public ::testing::TestWithParam<LightKind> {
protected:
    struct Case {
        SceneSnapshot scene;
        ShadowView view;
        glm::dvec3 p_ws, normal;
        double facing = 0.0;  // cosine between the normal and the way to the light
    };
    /// Points that are seen and in the view's map, with a plane that faces both light and camera.
    template <class Visit>
    void for_each_case(int rounds, Visit visit) {
        RandomScene random(print_seed());
        for (int round = 0; round < rounds; ++round) {
            const SceneSnapshot scene = random.scene(GetParam());
            const ShadowFrame frame = fitted(scene);
            for (const ShadowView& view : frame.fitted.views)
                for (const std::uint32_t r : frame.sets.receiver_items) {
                    const glm::dvec3 p = random_point(random, scene.instances[r].bounds_ws), n = random.direction();
                    const glm::vec4 q = view.map_from_anchor * glm::vec4(glm::vec3(p - view.pose.anchor_ws_m), 1.0f);
                    const glm::vec3 at = glm::vec3(q) / q.w;
                    const bool in_map = q.w > 0.0f && at.x > 0.0f && at.x < 1.0f && at.y > 0.0f && at.y < 1.0f;
                    const glm::dvec3 to_light = glm::normalize(source_of(scene.lights[0], p) - p);
                    const double facing = glm::dot(n, to_light);
                    const double depth_m =
                        glm::dot(scene.consumers[0].position_ws_m - p, scene.consumers[0].rotation_ws[2]);
                    if (!in_map || !seen(scene.consumers[0], p) || !reaches(scene.lights[0], p) ||
                        facing < kLeastFacing || depth_m < view.cascade.seen_from_m ||
                        glm::dot(n, scene.consumers[0].position_ws_m - p) < 0.0)
                        continue;
                    visit(frame, Case{scene, view, p, n, facing});
                }
        }
    }
};

TEST_P(PredictedError, ATexelsExtentIsWhatShiftingThePointByATexelShows) {
    int cases = 0;
    for_each_case(200, [&](const ShadowFrame&, const Case& c) {
        constexpr Exact kSmall = 1e-6L;  // texel; the extent is a derivative
        const vec3x p(c.p_ws), n(c.normal);
        Exact extent_px = 0;
        for (const int sign : {-1, 1}) {
            const vec3x q = beside(c.view, p, n, kSmall, sign * kSmall);
            extent_px = std::max(extent_px,
                                 glm::distance(pixel_of(c.scene.consumers[0], q), pixel_of(c.scene.consumers[0], p)));
        }
        extent_px /= kSmall;
        const auto stated = static_cast<Exact>(texel_extent_px(c.view, c.scene.consumers[0], c.p_ws, c.normal));
        EXPECT_NEAR(static_cast<double>(stated / extent_px), 1.0, c.facing > 0.01 ? 1e-4 : 1e-2);
        ++cases;
    });
    EXPECT_GT(cases, 100);
}

TEST_P(PredictedError, AViewStatesABoundForEveryReceiverBySlope) {
    constexpr double kReach = 0.5;
    int flat = 0, steep = 0, beyond = 0;
    for_each_case(400, [&](const ShadowFrame&, const Case& c) {
        const double own_px = edge_error_px(texel_extent_px(c.view, c.scene.consumers[0], c.p_ws, c.normal), kReach);
        EXPECT_LE(own_px, stated_error_px(c.view, c.facing, kReach) * (1.0 + 1e-9)) << c.facing;
        ++(c.facing >= 1.0 / kSteepestReceiver ? flat : steep);
        beyond += own_px > c.view.error.texel_edge_px ? 1 : 0;
    });
    EXPECT_GT(flat, 100);
    EXPECT_GT(steep, 100);
    EXPECT_GT(beyond, 0) << "otherwise the slope need not be told";
}

TEST(StatedError, IsThePredictedOneWithinSixtyDegreesAndGrowsAsOneOverTheCosine) {
    ShadowView view;
    view.error.extent_px = 3.0;
    EXPECT_DOUBLE_EQ(stated_error_px(view, 1.0, 0.5), edge_error_px(3.0, 0.5));
    EXPECT_DOUBLE_EQ(stated_error_px(view, 0.5, 0.5), edge_error_px(3.0, 0.5));
    EXPECT_DOUBLE_EQ(stated_error_px(view, 0.25, 0.5), edge_error_px(6.0, 0.5));
    EXPECT_EQ(stated_error_px(view, 0.0, 0.5), std::numeric_limits<double>::infinity());
    EXPECT_EQ(stated_error_px(view, -1.0, 0.5), std::numeric_limits<double>::infinity());
}

TEST_P(PredictedError, IsNotLooserThanTheTiltItAllows) {
    // Over a scene, the largest extent of planes square to the light comes near the bound. The rest is the tilt, and
    // corners that no sample hit.
    std::vector<double> ratios;
    for_each_case(1000, [&](const ShadowFrame&, const Case& c) {
        const glm::dvec3 square = glm::normalize(source_of(c.scene.lights[0], c.p_ws) - c.p_ws);
        ratios.push_back(c.view.error.extent_px / texel_extent_px(c.view, c.scene.consumers[0], c.p_ws, square));
    });
    ASSERT_GT(ratios.size(), 100u);
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
    EXPECT_LE(ratios[ratios.size() / 2], 3.0 * kSteepestReceiver);
}

INSTANTIATE_TEST_SUITE_P(EachKind, PredictedError,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& param) { return std::string(light_kind_row(param.param).name); });

TEST(ToldApart, IsTheWayThatTwoStepsOfTheFormatTake) {
    ShadowView flat;
    flat.depth.near_m = 3.0;
    flat.depth.far_m = 23.0;
    EXPECT_EQ(min_resolvable_gap_m(flat, DepthFormat::d32f, {}), 0.0);
    EXPECT_DOUBLE_EQ(min_resolvable_gap_m(flat, DepthFormat::d16, {}), 2.0 * 20.0 / 65535.0);

    ShadowView lamp;
    lamp.projection = ViewProjection::perspective;
    lamp.pose.anchor_ws_m = {1.0, 2.0, 3.0};
    lamp.depth.beta = 0.01;
    for (const double z_m : {0.5, 5.0, 500.0}) {
        const glm::dvec3 p = lamp.pose.anchor_ws_m + glm::dvec3(0.4 * z_m, -0.3 * z_m, -z_m);
        const double way = glm::length(p - lamp.pose.anchor_ws_m);
        const double caster_z_m = z_m * (1.0 - min_resolvable_gap_m(lamp, DepthFormat::d16, p) / way);
        EXPECT_GT(caster_z_m, 0.0) << "it is before the light";
        EXPECT_NEAR(lamp.depth.beta / caster_z_m - lamp.depth.beta / z_m, 2.0 / 65535.0, 1e-15) << z_m;
        EXPECT_EQ(min_resolvable_gap_m(lamp, DepthFormat::d32f, p), 0.0);
    }
}

TEST(EdgeError, IsTheTexelsShareAndThePixels) {
    EXPECT_DOUBLE_EQ(edge_error_px(0.0, 0.5), 1.0);
    EXPECT_DOUBLE_EQ(edge_error_px(3.0, 0.5), 4.0);
    EXPECT_DOUBLE_EQ(edge_error_px(3.0, 1.5), 7.0);
}

}  // namespace
}  // namespace gnomon::shadow
