#include "systems/shadow/predicted_error.h"

#include <gtest/gtest.h>

#include "systems/shadow/light_kinds.h"
#include "tests/unit/shadow/random_scene.h"

namespace gnomon::shadow {
namespace {

/// Pixels, by the way the picture is made and no formula of the prediction.
glm::dvec2 pixel_of(const ConsumerItem& c, const glm::dvec3& p_ws) {
    const glm::dvec3 p = (p_ws - c.position_ws_m) * c.rotation_ws;
    const double half_y = std::tan(0.5 * c.fov_y_rad);
    return glm::dvec2(p.x, p.y) / -p.z / (2.0 * half_y) * static_cast<double>(c.viewport_px.y);
}

/// The point of the plane (p_ws, normal) that lies texel (du, dv) beside p_ws in the map.
glm::dvec3 beside(const ShadowView& view, const glm::dvec3& p_ws, const glm::dvec3& normal, double du, double dv) {
    const bool flat = view.projection == ViewProjection::orthographic;
    const double z_m = flat ? 1.0 : glm::dot(view.anchor_ws_m - p_ws, view.axis_back);
    const glm::dvec3 shifted =
        p_ws + view.axis_u * (du * view.texel_u * z_m) + view.axis_v * (dv * view.texel_v * z_m);
    const glm::dvec3 source = flat ? shifted + view.axis_back : view.anchor_ws_m;
    const glm::dvec3 ray = shifted - source;
    return source + ray * (glm::dot(p_ws - source, normal) / glm::dot(ray, normal));
}

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
            for (const ShadowView& view : frame.views)
                for (const std::uint32_t r : frame.receiver_items) {
                    const glm::dvec3 p = random_point(random, scene.instances[r].bounds_ws), n = random.direction();
                    const glm::vec4 q = view.map_from_anchor * glm::vec4(glm::vec3(p - view.anchor_ws_m), 1.0f);
                    const glm::vec3 at = glm::vec3(q) / q.w;
                    const bool in_map = q.w > 0.0f && at.x > 0.0f && at.x < 1.0f && at.y > 0.0f && at.y < 1.0f;
                    const glm::dvec3 to_light = glm::normalize(source_of(scene.lights[0], p) - p);
                    const double facing = glm::dot(n, to_light);
                    const double depth_m = glm::dot(scene.consumers[0].position_ws_m - p, scene.consumers[0].rotation_ws[2]);
                    if (!in_map || !seen(scene.consumers[0], p) || !reaches(scene.lights[0], p) || facing < 0.1 ||
                        depth_m < view.seen_from_m || glm::dot(n, scene.consumers[0].position_ws_m - p) < 0.0)
                        continue;
                    visit(frame, Case{scene, view, p, n, facing});
                }
        }
    }
};

TEST_P(PredictedError, ATexelsExtentIsWhatShiftingThePointByATexelShows) {
    int cases = 0;
    for_each_case(200, [&](const ShadowFrame&, const Case& c) {
        constexpr double kSmall = 1e-4;  // of a texel: the extent is a derivative
        double extent_px = 0.0;
        for (const double sign : {-1.0, 1.0}) {
            const glm::dvec3 q = beside(c.view, c.p_ws, c.normal, kSmall, sign * kSmall);
            extent_px = std::max(extent_px, glm::distance(pixel_of(c.scene.consumers[0], q), pixel_of(c.scene.consumers[0], c.p_ws)));
        }
        extent_px /= kSmall;
        EXPECT_NEAR(texel_extent_px(c.view, c.scene.consumers[0], c.p_ws, c.normal) / extent_px, 1.0, 1e-2);
        ++cases;
    });
    EXPECT_GT(cases, 100);
}

TEST_P(PredictedError, BoundsEveryReceiverThatFacesTheLightWithinSixtyDegrees) {
    int cases = 0, beyond = 0;
    for_each_case(200, [&](const ShadowFrame&, const Case& c) {
        const double extent_px = texel_extent_px(c.view, c.scene.consumers[0], c.p_ws, c.normal);
        if (c.facing >= 1.0 / kSteepestReceiver) {
            EXPECT_LE(extent_px, c.view.texel_extent_px * (1.0 + 1e-9));
            ++cases;
        } else {
            beyond += extent_px > c.view.texel_extent_px ? 1 : 0;
        }
    });
    EXPECT_GT(cases, 100);
    EXPECT_GT(beyond, 0) << "otherwise the limit says nothing";
}

TEST_P(PredictedError, IsNotLooserThanTheTiltItAllows) {
    // Over a scene, the largest extent of planes square to the light comes near the bound, but for the tilt and for
    // corners that no sample hit.
    std::vector<double> ratios;
    for_each_case(1000, [&](const ShadowFrame&, const Case& c) {
        const glm::dvec3 square = glm::normalize(source_of(c.scene.lights[0], c.p_ws) - c.p_ws);
        ratios.push_back(c.view.texel_extent_px / texel_extent_px(c.view, c.scene.consumers[0], c.p_ws, square));
    });
    ASSERT_GT(ratios.size(), 100u);
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
    EXPECT_LE(ratios[ratios.size() / 2], 3.0 * kSteepestReceiver);
}

INSTANTIATE_TEST_SUITE_P(EachKind, PredictedError, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& param) { return std::string(light_kind_row(param.param).name); });

TEST(EdgeError, IsTheTexelsShareAndThePixels) {
    EXPECT_DOUBLE_EQ(edge_error_px(0.0, 0.5), 1.0);
    EXPECT_DOUBLE_EQ(edge_error_px(3.0, 0.5), 4.0);
    EXPECT_DOUBLE_EQ(edge_error_px(3.0, 1.5), 7.0);
}

}  // namespace
}  // namespace gnomon::shadow
