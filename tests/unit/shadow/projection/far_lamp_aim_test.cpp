#include "systems/shadow/projection/far_lamp_aim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "systems/shadow/projection/perspective_view.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/unit/shadow/random_scene.h"

/// Lamps that stand so far away that one view of what is seen serves them.
namespace gnomon::shadow {
namespace {

constexpr LightKind kLamps[] = {LightKind::point, LightKind::spot};
constexpr double kDistances_m[] = {2e3, 1e5, 1e7, 1e9};

/// Makes the random scene's boxes, with a lamp that stands `distance_m` from their middle and looks at it.
SceneSnapshot far_scene(RandomScene& random, LightKind kind, double distance_m) {
    SceneSnapshot scene = random.scene(kind);
    LightItem& light = scene.lights[0];
    const glm::dvec3 back = random.direction();
    light.position_ws_m = back * distance_m;
    light.rotation_ws = math::basis_from_back(back);
    light.range_m = 0.0;
    light.outer_cone_rad = 0.6;
    light.inner_cone_rad = 0.3;
    return scene;
}

const ShadowView* aimed_view(const ShadowFrame& frame) {
    const bool aimed = frame.fitted.views.size() == 1 && frame.fitted.lights[0].request.projection.aim.used &&
                       frame.fitted.views[0].projection == ViewProjection::perspective;
    return aimed ? frame.fitted.views.data() : nullptr;
}

struct Placed {
    glm::dvec2 map{0.0};
    double depth = 0.0;
};
/// Places a point as the depth pass and the lookup do: in float, from the anchor.
Placed placed(const ShadowView& view, const glm::dvec3& p_ws) {
    const glm::vec4 q = view.map_from_anchor * glm::vec4(glm::vec3(p_ws - view.pose.anchor_ws_m), 1.0f);
    return {glm::dvec2(q) / static_cast<double>(q.w), static_cast<double>(q.z / q.w)};
}
/// Places a point in double, from the light itself.
Placed truly(const ShadowView& view, const LightItem& light, const glm::dvec3& p_ws) {
    const glm::dvec3 p = (p_ws - light.position_ws_m) * glm::dmat3(view.pose.axis_u, view.pose.axis_v, view.pose.axis_back);
    return {(glm::dvec2(p) / -p.z - view.plane.tan_low) / (view.plane.tan_high - view.plane.tan_low),
            view.depth.near_m * (view.depth.far_m + p.z) / (-p.z * (view.depth.far_m - view.depth.near_m))};
}

/// Converts an error of depth to one along the view's axis, as a share of a texel's diagonal there.
double off_texel(const ShadowView& view, const LightItem& light, const glm::dvec3& p_ws, double depth_off) {
    const double z_m = glm::dot(light.position_ws_m - p_ws, view.pose.axis_back);
    const double off_m = depth_off * z_m * z_m * (view.depth.far_m - view.depth.near_m) / (view.depth.near_m * view.depth.far_m);
    return off_m / (z_m * glm::length(glm::dvec2(view.plane.texel_u, view.plane.texel_v)));
}

TEST(FarLampAim, HoldsAllThatIsSeenAndLittleMore) {
    const std::uint64_t seed = print_seed();
    RandomScene random(seed);
    int fits = 0;
    for (int round = 0; round < 60; ++round) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round));
        const LightKind kind = kLamps[round % 2];
        const SceneSnapshot scene = far_scene(random, kind, kDistances_m[round / 2 % 4]);
        const ShadowFrame frame = fitted(scene);
        if (frame.statuses[0].skipped() != Reason::none) continue;
        const ShadowView* view = aimed_view(frame);
        ASSERT_TRUE(view);
        ++fits;
        glm::dvec2 low(1.0), high(0.0);
        for (const glm::dvec3& p_ws : frame.sets.receiver_points_ws) {
            const Placed at = placed(*view, p_ws);
            ASSERT_GE(std::min(at.map.x, at.map.y), 0.0);
            ASSERT_LE(std::max(at.map.x, at.map.y), 1.0);
            ASSERT_GE(at.depth, 0.0);
            ASSERT_LE(at.depth, 1.0);
            low = glm::min(low, at.map);
            high = glm::max(high, at.map);
        }
        // A step, a sixteenth for its place, and the filter's border.
        const double longer = std::max(high.x - low.x, high.y - low.y);
        EXPECT_GT(longer, 0.6);
        EXPECT_LT(glm::distance(apex_ws_m(*view), scene.lights[0].position_ws_m),
                  1e-15 * glm::length(scene.lights[0].position_ws_m) + 1e-12);
    }
    EXPECT_GT(fits, 20);
}

TEST(FarLampAim, FloatsPlaceAPointInItsTexelHoweverFarTheLampIs) {
    constexpr double kMostOff_texel = 1.0 / 16.0;
    RandomScene random(print_seed());
    double worst_about_lamp = 0.0;
    for (int round = 0; round < 40; ++round) {
        SceneSnapshot scene = far_scene(random, kLamps[round % 2], kDistances_m[round / 2 % 3]);
        scene.lights[0].shadow.resolution_px = 2048;
        const ShadowFrame frame = fitted(scene);
        if (frame.statuses[0].skipped() != Reason::none) continue;
        const ShadowView* view = aimed_view(frame);
        ASSERT_TRUE(view);
        const TangentRectangle sides{view->plane.tan_low, view->plane.tan_high};
        const ShadowView about_lamp = perspective_view(apex_ws_m(*view), {view->pose.axis_u, view->pose.axis_v, view->pose.axis_back},
                                                       sides, {view->depth.near_m, view->depth.far_m}, 2048.0);
        // The matrix's own rounding shifts all depths alike, those of casters as well: it changes no comparison of two.
        const glm::dvec3& first_ws = frame.sets.receiver_points_ws.front();
        const double shift = placed(*view, first_ws).depth - truly(*view, scene.lights[0], first_ws).depth;
        for (const glm::dvec3& p_ws : frame.sets.receiver_points_ws) {
            const Placed at = placed(*view, p_ws), truth = truly(*view, scene.lights[0], p_ws);
            EXPECT_LT(glm::length(at.map - truth.map) * 2048.0, kMostOff_texel) << round;
            // Depths are as coarse as texels only where the request notes it: a caster stands beside the lamp.
            if (frame.fitted.lights[0].request.note != Reason::depth_coarse) {
                EXPECT_LT(off_texel(*view, scene.lights[0], p_ws, std::abs(at.depth - truth.depth - shift)), 1.0) << round;
            }
            worst_about_lamp =
                std::max(worst_about_lamp, glm::length(placed(about_lamp, p_ws).map - truth.map) * 2048.0);
        }
    }
    EXPECT_GT(worst_about_lamp, 16.0 * kMostOff_texel) << "the anchor at the lamp would do";
}

/// Makes a ground with a post, and a camera that looks at its middle.
SceneSnapshot yard(double distance_m) {
    RandomScene random(1);
    SceneSnapshot scene = far_scene(random, LightKind::point, distance_m);
    scene.instances.clear();
    InstanceItem ground, post;
    ground.bounds_ws = {{-8.0, -0.1, -8.0}, {8.0, 0.0, 8.0}};
    post.bounds_ws = {{-0.2, 0.0, -0.2}, {0.2, 2.0, 0.2}};
    post.gpu_slot = 1;
    post.casts = true;
    scene.instances = {ground, post};
    scene.consumers[0].position_ws_m = {0.0, 6.0, 9.0};
    scene.consumers[0].rotation_ws = math::basis_from_back({0.0, 6.0, 9.0});
    scene.consumers[0].fov_y_rad = 0.8;
    scene.lights[0].position_ws_m = glm::normalize(glm::dvec3(-0.4, 0.8, 0.3)) * distance_m;
    return scene;
}

TEST(FarLampAim, LeavesALampThatLightsMuchOfWhatItSeesItsOwnMaps) {
    for (const double distance_m : {3.0, 20.0, 60.0}) {
        SceneSnapshot scene = yard(distance_m);
        for (const LightKind kind : kLamps) {
            scene.lights[0].kind = kind;
            scene.lights[0].rotation_ws = math::basis_from_back(scene.lights[0].position_ws_m);
            const ShadowFrame frame = fitted(scene);
            EXPECT_FALSE(frame.fitted.lights[0].request.projection.aim.used) << distance_m;
            ASSERT_FALSE(frame.fitted.views.empty());
            for (const ShadowView& view : frame.fitted.views) EXPECT_EQ(view.pose.anchor_ws_m, scene.lights[0].position_ws_m);
        }
    }
}

TEST(FarLampAim, StaysWhileTheCameraTurnsAndWalksALittle) {
    SceneSnapshot scene = yard(5e3);
    History previous;
    ShadowFrame frame = fitted(scene, previous);
    ASSERT_TRUE(aimed_view(frame));
    const FarLampAim aim = frame.fitted.lights[0].request.projection.aim;
    int changes = 0;
    for (int i = 0; i < 200; ++i) {
        previous = frame.next_history;
        const ShadowView before = frame.fitted.views[0];
        const double turn = 0.3 * std::sin(0.05 * i);
        scene.consumers[0].position_ws_m = {3.0 * turn, 6.0, 9.0 + turn};
        scene.consumers[0].rotation_ws = math::basis_from_back({turn, 6.0, 9.0});
        frame = fitted(scene, previous);
        ASSERT_TRUE(aimed_view(frame));
        EXPECT_EQ(frame.fitted.lights[0].request.projection.aim, aim);
        changes += frame.fitted.views[0].clip_from_anchor != before.clip_from_anchor;
    }
    EXPECT_LE(changes, 12);
    EXPECT_EQ(fitted(scene, frame.next_history).fitted.views[0].clip_from_anchor, frame.fitted.views[0].clip_from_anchor);
}

TEST(FarLampAim, DoesNotComeAndGoWithALampThatSwaysWhereItBegins) {
    SceneSnapshot scene = yard(100.0);
    History previous;
    const auto aims_at = [&](double distance_m) {
        scene.lights[0].position_ws_m = glm::normalize(scene.lights[0].position_ws_m) * distance_m;
        const ShadowFrame frame = fitted(scene, previous);
        previous = frame.next_history;
        return frame.fitted.lights[0].request.projection.aim.used;
    };
    double begins_m = 50.0;
    while (!aims_at(begins_m) && begins_m < 1e4) begins_m *= 1.02;
    ASSERT_GT(begins_m, 60.0);
    ASSERT_LT(begins_m, 1e3);
    for (int i = 0; i < 50; ++i) EXPECT_TRUE(aims_at(begins_m * (1.0 + 0.2 * std::sin(i))));
    EXPECT_FALSE(aims_at(0.45 * begins_m));
    EXPECT_FALSE(aims_at(0.95 * begins_m));
}

/// Checks that a search that ends at what is too wide for any aim does not end at what is not.
TEST(FarLampAim, IsTheSameInWhateverOrderReceiversAreFound) {
    const std::uint64_t seed = print_seed();
    RandomScene random(seed);
    int aimed = 0, wide = 0;
    for (int round = 0; round < 400; ++round) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round));
        SceneSnapshot scene = far_scene(random, kLamps[round % 2], 20.0 * std::exp2(0.02 * round));
        const FarLampAim fresh = next_far_lamp_aim(scene, scene.lights[0], {});
        const FarLampAim previous = next_far_lamp_aim(scene, scene.lights[0], {true, {0.0, 0.0, 0.0}, 40.0});
        std::reverse(scene.instances.begin(), scene.instances.end());
        scene.tree_version = ~std::uint64_t{0};  // all are visited, in this order
        const FarLampAim other = next_far_lamp_aim(scene, scene.lights[0], {});
        const FarLampAim other_held = next_far_lamp_aim(scene, scene.lights[0], {true, {0.0, 0.0, 0.0}, 40.0});
        EXPECT_EQ(fresh.used, other.used);
        EXPECT_EQ(fresh.middle_ws_m, other.middle_ws_m);
        EXPECT_EQ(fresh.radius_m, other.radius_m);
        EXPECT_EQ(previous.used, other_held.used);
        EXPECT_EQ(previous.radius_m, other_held.radius_m);
        ++(fresh.used ? aimed : wide);
    }
    EXPECT_GT(aimed, 40);
    EXPECT_GT(wide, 40);
}

TEST(FarLampAim, LeavesOutWhatTheConeAndTheRangeLeaveDark) {
    constexpr double kFar_m = 2e4;
    SceneSnapshot scene = yard(kFar_m);
    InstanceItem beside;
    beside.bounds_ws = {{400.0, -0.1, -500.0}, {900.0, 0.0, -400.0}};
    beside.gpu_slot = 2;
    scene.instances.push_back(beside);
    scene.consumers[0].far_m = 1e4;
    scene.consumers[0].rotation_ws = math::basis_from_back({-1.0, 0.5, 1.0});
    const double both = fitted(scene).fitted.lights[0].request.projection.aim.radius_m;
    EXPECT_GT(both, 800.0) << "a point lights both";
    LightItem& light = scene.lights[0];
    light.range_m = kFar_m + 100.0;  // the other is 300 m farther than the yard
    const double by_range = fitted(scene).fitted.lights[0].request.projection.aim.radius_m;
    EXPECT_GT(by_range, 1.0);
    EXPECT_LT(by_range, 0.1 * both);
    light.range_m = 0.0;
    light.kind = LightKind::spot;
    light.rotation_ws = math::basis_from_back(light.position_ws_m);
    light.outer_cone_rad = 0.01;
    light.inner_cone_rad = 0.005;
    const double by_cone = fitted(scene).fitted.lights[0].request.projection.aim.radius_m;
    EXPECT_GT(by_cone, 1.0);
    EXPECT_LT(by_cone, 0.1 * both);
}

}  // namespace
}  // namespace gnomon::shadow
