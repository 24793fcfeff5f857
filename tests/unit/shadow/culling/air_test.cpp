#include <gmock/gmock.h>

#include <algorithm>

#include "systems/shadow/culling/error_points.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/oracle/caster_need.h"
#include "tests/oracle/fit_oracle.h"
#include "tests/unit/shadow/random_scene.h"

/// Boxes of air as receivers: what maps contain of them, and which errors they state.
namespace gnomon::shadow {
namespace {

constexpr LightKind kAirKinds[] = {LightKind::directional, LightKind::spot, LightKind::point};

/// Makes every receiver that does not cast a box of air.
void fill_with_air(SceneSnapshot& scene) {
    for (InstanceItem& item : scene.instances)
        if (!item.casts) item.mesh = kNoMesh;
    scene.air.any = true;
}

struct Counts {
    int points = 0, lost = 0, blockers = 0, missing = 0;
};

/// Counts places in the air that a camera sees and the light reaches, and casters between them and the light. Counts
/// the places that no view holds, and the casters that the view lacks.
Counts count_places(const SceneSnapshot& scene, const SceneSnapshot& fitted_for, RandomScene& random) {
    Counts counts;
    const LightItem& light = scene.lights[0];
    const ShadowFrame frame = fitted(fitted_for);
    const ShadowRequest& request = frame.fitted.lights.at(0).request;
    for (const InstanceItem& item : scene.instances) {
        if (!is_air(item) || !item.visible || !item.receives) continue;
        for (int k = 0; k < 20; ++k) {
            const glm::dvec3 p = random_point(random, item.bounds_ws);
            const oracle::Vector exact = oracle::exact(p);
            if (!oracle::sees(scene.consumers[0], exact, 1e-6L) || !oracle::reaches(light, exact, 1e-6L)) continue;
            const auto darkens = [&](const InstanceItem& caster) {
                return caster.casts && oracle::darkens(light, caster.bounds_ws, exact, 1e-6L);
            };
            const auto between = std::count_if(scene.instances.begin(), scene.instances.end(), darkens);
            ++counts.points;
            if (between == 0) continue;
            const oracle::Deciding views =
                oracle::deciding_views(frame.fitted.views, request, scene.consumers[0], exact, 0.0L);
            const ShadowView* view = views.view ? views.view : views.single;
            counts.blockers += static_cast<int>(between);
            if (!view || !oracle::holds(*view, exact, request.map.resolution_px, 0.0L)) {
                ++counts.lost;
                continue;
            }
            const auto casters = frame.fitted.casters_of(*view);
            for (std::uint32_t c = 0; c < scene.instances.size(); ++c)
                if (darkens(scene.instances[c]) && std::find(casters.begin(), casters.end(), c) == casters.end())
                    ++counts.missing;
        }
    }
    return counts;
}

TEST(Air, LiesInMapsThatHoldWhateverDarkensIt) {
    RandomScene random(print_seed());
    Counts all, without;
    for (int round = 0; round < 600; ++round) {
        SceneSnapshot scene = random.scene(kAirKinds[round % 3]);
        fill_with_air(scene);
        // A camera among the boxes: air begins at its near plane.
        if (round % 2 == 0) scene.consumers[0].position_ws_m = random.vector(4.0);
        const Counts found = count_places(scene, scene, random);
        all.points += found.points;
        all.blockers += found.blockers;
        EXPECT_EQ(found.lost, 0) << "round " << round;
        EXPECT_EQ(found.missing, 0) << "round " << round;
        SceneSnapshot undeclared = scene;
        for (InstanceItem& item : undeclared.instances) item.receives = item.receives && !is_air(item);
        const Counts control = count_places(scene, undeclared, random);
        without.lost += control.lost + control.missing;
        without.blockers += control.blockers;
    }
    EXPECT_GT(all.points, 1000);
    EXPECT_GT(all.blockers, 200);
    EXPECT_GT(20 * without.lost, without.blockers) << "control: of air that nobody declares maps lack more than 5 %";
}

/// Makes a ground of 40 m far before a camera that stands in a box of `mesh`, with a caster above.
SceneSnapshot around_the_camera(LightKind kind, std::uint32_t mesh) {
    SceneSnapshot scene;
    const auto add = [&](const math::Aabb& bounds, bool casts) -> InstanceItem& {
        InstanceItem& item = scene.instances.emplace_back();
        item.gpu_slot = static_cast<std::uint32_t>(scene.instances.size() - 1);
        item.bounds_ws = bounds;
        item.casts = casts;
        return item;
    };
    add({{-20.0, -0.1, -30.0}, {20.0, 0.0, -10.0}}, false);
    add({{-1.0, 2.0, -16.0}, {1.0, 3.0, -14.0}}, true);
    add({{-20.0, 0.0, -30.0}, {20.0, 4.0, 10.0}}, false).mesh = mesh;
    scene.air.any = mesh == kNoMesh;
    ConsumerItem& camera = scene.consumers.emplace_back();
    camera.position_ws_m = {0.0, 1.7, 0.0};
    camera.near_m = 0.05;
    LightItem& light = scene.lights.emplace_back();
    light.kind = kind;
    light.intensity = 1.0f;
    light.has_shadow = true;
    // All of it lies in one view of a lamp.
    light.outer_cone_rad = 0.9;
    light.position_ws_m = {0.0, 30.0, -5.0};
    light.rotation_ws = math::basis_from_back({0.1, 1.0, 0.1});
    return scene;
}

double largest_error_px(const ShadowFrame& frame) {
    double largest = 0.0;
    for (const ShadowView& view : frame.fitted.views) largest = std::max(largest, view.error.texel_edge_px);
    return largest;
}

TEST(Air, AroundACameraAsksForNoTexelsAsFineAsItsNearPlane) {
    for (const LightKind kind : kAirKinds) {
        SceneSnapshot scene = around_the_camera(kind, kNoMesh), as_surface = around_the_camera(kind, 0);
        for (SceneSnapshot* s : {&scene, &as_surface}) s->lights[0].shadow.resolution_px = 1024;
        const double air_px = largest_error_px(fitted(scene)), surface_px = largest_error_px(fitted(as_surface));
        EXPECT_GT(air_px, 0.0);
        EXPECT_LT(air_px, 0.1 * surface_px)
            << "control: a surface may be as near as its box; light " << static_cast<int>(kind);
    }
}

TEST(Air, AsksForAsMuchAsItsNearestPartThatCounts) {
    // It begins at 5 m, after an eighth of 30 m: nothing is left out of the error.
    SceneSnapshot scene = around_the_camera(LightKind::point, kNoMesh);
    scene.instances[2].bounds_ws = {{-20.0, 0.0, -30.0}, {20.0, 4.0, -5.0}};
    scene.lights[0].shadow.resolution_px = 1024;
    SceneSnapshot as_surface = scene;
    as_surface.instances[2].mesh = 0;
    as_surface.air.any = false;
    EXPECT_DOUBLE_EQ(largest_error_px(fitted(scene)), largest_error_px(fitted(as_surface)));
    SceneSnapshot without = scene;
    without.instances.pop_back();
    EXPECT_GT(largest_error_px(fitted(scene)), 1.2 * largest_error_px(fitted(without))) << "control: the box counts";
}

TEST(Air, LeavesPointsOfOtherScenesAlone) {
    RandomScene random(print_seed());
    for (int round = 0; round < 30; ++round) {
        const SceneSnapshot scene = random.scene(kAirKinds[round % 3]);
        const ShadowFrame frame = fitted(scene);
        EXPECT_TRUE(frame.sets.error_points_ws.empty());
        EXPECT_TRUE(frame.sets.nearest_surface_m.empty());
    }
}

TEST(Air, OfOtherLayersIsNoReceiver) {
    SceneSnapshot scene = around_the_camera(LightKind::point, kNoMesh);
    scene.instances[0].receives = false;
    EXPECT_EQ(fitted(scene).statuses[0].skipped(), Reason::none);
    scene.instances[2].receive_layers = 2;
    scene.lights[0].shadow.layers = 1;
    scene.instances[1].receives = false;
    EXPECT_EQ(fitted(scene).statuses[0].skipped(), Reason::no_visible_receiver);
}

}  // namespace
}  // namespace gnomon::shadow
