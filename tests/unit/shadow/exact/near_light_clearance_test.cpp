#include "systems/shadow/exact/near_light_clearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "engine/gl/device_recording.h"
#include "systems/shadow/frame/shadow_frame.h"
#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/projection/perspective_view.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "systems/shadow/request/map_textures.h"
#include "tests/unit/math/random_seed.h"
#include "tests/unit/oracle/analytic_scene.h"
#include "tests/unit/rays/triangle_soup.h"

namespace gnomon::test {
namespace {

constexpr float kRadius_m = 0.1f;
constexpr double kMost_m = shadow::kClearance_radii * static_cast<double>(kRadius_m);

glm::dmat3 face_axes(std::uint32_t face) {
    const shadow::CubeFace& axes = shadow::cube_face(face);
    return glm::mat3_cast(shadow::cube_turn()) * glm::dmat3(axes.axis_u, axes.axis_v, axes.axis_back);
}

std::vector<shadow::ShadowView> faces() {
    std::vector<shadow::ShadowView> views;
    for (std::uint32_t face = 0; face < 6; ++face) {
        views.push_back(shadow::perspective_view({}, face_axes(face), {}, {0.1, 50.0}, 512));
        views.back().projection = shadow::ViewProjection::cube_face;
        views.back().layer = face;
    }
    return views;
}

/// Measures the clearance of a spot in the origin that shines along -z, with one view of tangent 1 from 0.1 m on.
/// Without `whole_view` the tangent is 0.5; `cube`: a point light with six faces.
double clearance(oracle::AnalyticScene& scene, bool whole_view = true, bool cube = false) {
    gl::RecordingDevice device;
    auto gpu = GpuScene::create(device, scene.library);
    EXPECT_TRUE(gpu);
    if (!gpu) return -1.0;
    for (InstanceItem& item : scene.snapshot.instances) {
        item.bounds_ws = {};
        for (const assets::Vertex& vertex : scene.library.meshes[item.mesh].vertices)
            item.bounds_ws =
                math::extended(item.bounds_ws, item.basis * glm::dvec3(vertex.position_ms) + item.translation_ws_m);
    }
    LightItem light;
    light.kind = cube ? LightKind::point : LightKind::spot;
    light.shadow.filter = ShadowFilter::exact_soft;
    light.source_radius_m = kRadius_m;
    scene.snapshot.lights = {light};
    shadow::ShadowFrame frame;
    frame.decisions.resize(1);
    frame.statuses.resize(1);
    shadow::MapSettings& map = frame.decisions[0].request.map;
    map.filter = light.shadow.filter;
    map.filtering = shadow::filter_settings(light, 512);
    const double side = whole_view ? 1.0 : 0.5;
    frame.fitted.views = {
        shadow::perspective_view({}, glm::dmat3(1.0), {glm::dvec2(-side), glm::dvec2(side)}, {0.1, 50.0}, 512)};
    if (cube) frame.fitted.views = faces();
    const std::size_t views = frame.fitted.views.size();
    frame.fitted.lights.resize(1);
    frame.fitted.lights[0].views.count = static_cast<std::uint32_t>(views);
    frame.maps.resize(views);
    frame.updates.resize(views);
    for (shadow::MapAssignment& assigned : frame.maps) assigned.texture = gl::TextureHandle{1};
    const shadow::DrawnViews drawn = shadow::drawn_views(frame);
    shadow::measure_clearances({scene.snapshot, gpu.value(), drawn}, frame.clearances_m, {});
    return frame.clearances_m[0];
}

TEST(Clearance, OfAnEmptyWorldIsAsFarAsItIsLookedFor) {
    oracle::AnalyticScene scene;
    scene.place(scene.add_square(), {0.0, 0.0, -1000.0});
    EXPECT_NEAR(clearance(scene), kMost_m, 1e-6);
}

TEST(Clearance, LeavesOutWhatTheViewHoldsWholeAndCountsWhatItHoldsInPart) {
    oracle::AnalyticScene scene;
    scene.place(scene.add_square(), {0.0, 0.0, -1.0});  // ±0.5 at distance 1
    EXPECT_NEAR(clearance(scene), kMost_m, 1e-6);
    EXPECT_NEAR(clearance(scene, false), 1.0, 1e-9) << "its corners lie on the border: it may go on beyond";
    EXPECT_LT(kMost_m, 4.0);
}

TEST(Clearance, CountsWhatStandsBeforeTheNearPlane) {
    oracle::AnalyticScene scene;
    scene.place(scene.add_square(), {0.0, 0.0, -0.05}, glm::dmat3(0.01));
    EXPECT_NEAR(clearance(scene), 0.05, 1e-9);
}

TEST(Clearance, CountsWhatStandsBesideAndWhatTheSourceReachesBehindAndNothingElseBehind) {
    oracle::AnalyticScene beside, reached, behind, casts_nothing;
    const glm::dmat3 upright({0, 0, 1}, {0, 1, 0}, {1, 0, 0});
    beside.place(beside.add_square(), {0.25, 0.0, 0.0}, upright);
    EXPECT_NEAR(clearance(beside), 0.25, 1e-9);
    oracle::AnalyticScene far_beside;
    far_beside.place(far_beside.add_square(), {0.75, 0.0, 0.0}, upright);  // 0.18 m from the pyramid
    EXPECT_NEAR(clearance(far_beside), kMost_m, 1e-6);
    reached.place(reached.add_square(), {0.0, 0.0, 0.09});
    EXPECT_NEAR(clearance(reached), 0.09, 1e-9);
    behind.place(behind.add_square(), {0.0, 0.0, 0.11});
    EXPECT_NEAR(clearance(behind), kMost_m, 1e-6);
    casts_nothing.place(casts_nothing.add_square(), {2.0, 0.0, 0.0}).casts = false;
    EXPECT_NEAR(clearance(casts_nothing), kMost_m, 1e-6);
}

// A place in the next face sees part of the source past it, and knows nothing of it.
TEST(Clearance, OfACubeCountsWhatOneFaceHoldsWholeBesideAnother) {
    const glm::dmat3 axes = face_axes(3);
    const auto of_card_at = [&](double tangent) {
        oracle::AnalyticScene scene;
        scene.place(scene.add_square(), axes * glm::dvec3(tangent, 0.0, -1.0), axes * 0.02);
        return clearance(scene, true, true);
    };
    EXPECT_NEAR(of_card_at(0.0), kMost_m, 1e-6);
    EXPECT_NEAR(of_card_at(0.9), std::hypot(0.89, 1.0), 1e-6) << "0.07 m from the neighbour's pyramid";
}

TEST(Clearance, IsTheLeastDistanceOfAnyPointOfAnyTriangle) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> share(-1.0, 1.0), part(0.0, 1.0);
    for (int round = 0; round < 50; ++round) {
        oracle::AnalyticScene scene;
        std::vector<glm::vec3> points;
        for (int i = 0; i < 3; ++i)
            points.emplace_back(share(random), share(random), share(random));
        // Beside the light, across its own plane.
        const glm::dvec3 at(0.0, 1.5, 0.0);
        scene.place(scene.add_mesh(points, {0, 1, 2}), at);
        double least_m = kMost_m;
        for (int i = 0; i < 20000; ++i) {
            double u = part(random), v = part(random);
            if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
            const glm::dvec3 p = at + (1.0 - u - v) * glm::dvec3(points[0]) + u * glm::dvec3(points[1]) + v * glm::dvec3(points[2]);
            least_m = std::min(least_m, glm::length(p));
        }
        const double found_m = clearance(scene);
        if (found_m >= kMost_m * (1.0 - 1e-6)) continue;  // the view contains it whole, or it is behind
        EXPECT_LE(found_m, least_m + 1e-9);
        EXPECT_GE(found_m, least_m - 0.1) << "the nearest of so many points is no farther away";
    }
}

}  // namespace
}  // namespace gnomon::test
