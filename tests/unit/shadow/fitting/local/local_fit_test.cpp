#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "systems/shadow/fitting/local/fit_hysteresis.h"
#include "systems/shadow/fitting/size_steps.h"
#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/projection/spot_cube_transition.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/unit/shadow/fitting/directional/cascade_waste.h"
#include "tests/unit/shadow/random_scene.h"

/// What the fits of spots and point lights choose, and how long they keep it.
namespace gnomon::shadow {
namespace {

constexpr double kDegree = 0.017453292519943295;

math::Aabb box(const glm::dvec3& centre, double half) { return {centre - half, centre + half}; }

InstanceItem instance(const math::Aabb& bounds_ws, bool casts) {
    static std::uint32_t slot = 0;
    InstanceItem item;
    item.bounds_ws = bounds_ws;
    item.casts = casts;
    item.gpu_slot = slot++;
    return item;
}

/// Makes a camera at (0, 2, 12) that looks along -Z, and a light 5 m above the origin that looks down.
SceneSnapshot stage(LightKind kind, double outer_cone_rad = 0.7) {
    SceneSnapshot s;
    ConsumerItem camera;
    camera.position_ws_m = {0.0, 2.0, 12.0};
    camera.viewport_px = {640, 360};
    s.consumers.push_back(camera);
    LightItem light;
    light.entity = {1, 0};
    light.kind = kind;
    light.intensity = 1.0f;
    light.has_shadow = true;
    light.shadow.resolution_px = 512;
    light.position_ws_m = {0.0, 5.0, 0.0};
    light.rotation_ws = math::basis_from_back({0.0, 1.0, 0.0});
    light.outer_cone_rad = outer_cone_rad;
    light.inner_cone_rad = 0.5 * outer_cone_rad;
    s.lights.push_back(light);
    return s;
}

SceneSnapshot floor_and_posts(LightKind kind, double outer_cone_rad = 0.7) {
    SceneSnapshot s = stage(kind, outer_cone_rad);
    s.instances.push_back(instance({{-20.0, -0.1, -20.0}, {20.0, 0.0, 20.0}}, false));
    for (const double x : {-1.5, 0.0, 1.5})
        s.instances.push_back(instance({{x - 0.1, 0.0, -0.1}, {x + 0.1, 1.0, 0.1}}, true));
    return s;
}

double map_area(const ShadowView& view) {
    const glm::dvec2 size = view.plane.tan_high - view.plane.tan_low;
    return size.x * size.y;
}

TEST(LocalFit, ASpotIsCroppedToTheReceiversThatAreSeen) {
    SceneSnapshot s = stage(LightKind::spot);
    s.instances.push_back(instance(box({0.8, 0.0, 0.5}, 0.3), false));
    s.instances.push_back(instance(box({0.7, 1.0, 0.4}, 0.2), true));
    const ShadowFrame frame = fitted(s);
    ASSERT_EQ(frame.fitted.views.size(), 1u);
    const double whole = 2.0 * std::tan(0.7) / 512.0;
    EXPECT_LT(frame.fitted.views[0].plane.texel_u, 0.25 * whole);
    EXPECT_LT(frame.fitted.views[0].plane.texel_v, 0.25 * whole);

    s.instances.push_back(instance({{-20.0, -0.1, -20.0}, {20.0, 0.0, 20.0}}, false));
    s.consumers[0].position_ws_m = {0.0, 30.0, 1.0};  // sees all that the cone lights
    s.consumers[0].rotation_ws = math::basis_from_back({0.0, 1.0, 0.0});
    const ShadowFrame all = fitted(s);
    ASSERT_EQ(all.fitted.views.size(), 1u);
    EXPECT_NEAR(all.fitted.views[0].plane.texel_u, whole, 0.05 * whole) << "nothing to crop";
}

TEST(LocalFit, NearAndFarHoldCastersAndReceiversWithinTwoSteps) {
    const ShadowFrame frame = fitted(floor_and_posts(LightKind::spot));
    ASSERT_EQ(frame.fitted.views.size(), 1u);
    EXPECT_LE(frame.fitted.views[0].depth.near_m, 4.0);  // the posts' tops
    EXPECT_GE(frame.fitted.views[0].depth.near_m, 4.0 / 1.2);
    EXPECT_GE(frame.fitted.views[0].depth.far_m, 5.1);
    EXPECT_LE(frame.fitted.views[0].depth.far_m, 5.1 * 1.2);
}

TEST(LocalFit, DepthsCoarserThanTexelsAreReported) {
    const auto note = [](DepthFormat format, float near_m) {
        SceneSnapshot s = floor_and_posts(LightKind::spot);
        s.lights[0].tuning.maps.depth_format = format;
        s.lights[0].tuning.projection.near_m = near_m;
        return fitted(s).fitted.lights[0].request.note;
    };
    EXPECT_EQ(note(DepthFormat::d16, 0.0f), Reason::none) << "fitted from 4 to 5 m";
    EXPECT_EQ(note(DepthFormat::d16, 0.001f), Reason::depth_coarse) << "5 m in steps of 40 cm";
    EXPECT_EQ(note(DepthFormat::d24, 0.001f), Reason::none);
    EXPECT_EQ(note(DepthFormat::d24, 0.00001f), Reason::depth_coarse);
    EXPECT_EQ(note(DepthFormat::d32f, 0.00001f), Reason::none);
}

/// Fits a walk and counts how often any view's matrix changed.
struct Walk {
    int fits = 0, changes = 0;
};
Walk walk(SceneSnapshot scene, bool with_history) {
    Walk result;
    History previous;
    std::vector<glm::mat4> last;
    for (int i = 0; i < 200; ++i) {
        scene.consumers[0].position_ws_m += glm::dvec3(0.011, 0.0, -0.017);
        ShadowFrame frame = fitted(scene, previous);
        std::vector<glm::mat4> now;
        for (const ShadowView& view : frame.fitted.views) now.push_back(view.clip_from_anchor);
        result.fits += now.empty() ? 0 : 1;
        result.changes += i > 0 && now != last ? 1 : 0;
        last = now;
        if (with_history) previous = frame.next_history;
    }
    return result;
}

TEST(LocalFit, WhileTheCameraWalksTheMapsStayButForAFewSteps) {
    for (const LightKind kind : {LightKind::spot, LightKind::point}) {
        const Walk result = walk(floor_and_posts(kind), true);
        EXPECT_EQ(result.fits, 200);
        EXPECT_LE(result.changes, 4) << light_kind_row(kind).name;
    }
}

TEST(LocalFit, ACameraThatBobsAcrossAStepMovesNothing) {
    SceneSnapshot s = floor_and_posts(LightKind::spot);
    for (InstanceItem& item : s.instances) item.receives = !item.casts;
    s.instances.push_back(instance(box({0.0, 2.0, -1.2}, 0.4), true));
    s.instances.back().receives = false;
    for (const bool remembers : {true, false}) {
        History previous;
        std::set<double> areas;
        for (int i = 0; i < 400; ++i) {
            // Where the sight begins to leave the cone, one way and back, ever again; the whole way crosses a step.
            s.consumers[0].position_ws_m.z = 3.0 + 0.5 * std::sin(0.3 * i);
            const ShadowFrame frame = fitted(s, previous);
            ASSERT_EQ(frame.fitted.views.size(), 1u);
            if (i > 40) areas.insert(map_area(frame.fitted.views[0]));
            if (remembers) previous = frame.next_history;
        }
        if (remembers)
            EXPECT_EQ(areas.size(), 1u);
        else
            EXPECT_GT(areas.size(), 1u) << "otherwise this test says nothing";
    }
}

/// Counts how often near changes while a box moves up toward the light and down again, five times in 300 frames.
int near_changes(LightKind kind, DepthFormat format) {
    SceneSnapshot s = floor_and_posts(kind);
    s.lights[0].tuning.maps.depth_format = format;
    s.instances.push_back(instance(box({0.4, 1.5, 0.0}, 0.2), true));
    History previous;
    int changes = 0;
    double last_m = 0.0;
    for (int i = 0; i < 300; ++i) {
        const double y_m = 2.4 - 1.2 * std::cos(6.283185307179586 * i / 60.0);
        s.instances.back().bounds_ws = box({0.4, y_m, 0.0}, 0.2);
        const ShadowFrame frame = fitted(s, previous);
        previous = frame.next_history;
        EXPECT_FALSE(frame.fitted.views.empty());
        for (const ShadowView& view : frame.fitted.views) EXPECT_LE(view.depth.near_m, 5.0 - y_m - 0.2);
        changes += i > 0 && frame.fitted.views[0].depth.near_m != last_m ? 1 : 0;
        last_m = frame.fitted.views[0].depth.near_m;
    }
    return changes;
}

TEST(LocalFit, AThingThatGoesToAndFroMovesANearPlaneThatCostsNothingButOnce) {
    for (const LightKind kind : {LightKind::spot, LightKind::point}) {
        const int free = near_changes(kind, DepthFormat::d32f), fixed = near_changes(kind, DepthFormat::d24);
        std::cout << light_kind_row(kind).name << ": near changes " << free << " times in 300 frames, " << fixed
                  << " where it costs precision\n";
        EXPECT_LE(free, 2);
        EXPECT_GT(fixed, 20) << "otherwise this test says nothing";
    }
}

TEST(LocalFit, AnyHistoryIsSafe) {
    RandomScene random(print_seed());
    std::size_t compared = 0, more = 0;
    for (int round = 0; round < 200; ++round) {
        const SceneSnapshot scene = random.scene(round % 2 == 0 ? LightKind::spot : LightKind::point);
        History wrong = fitted(scene).next_history;
        if (wrong.lights.empty()) continue;
        for (ViewFitHistory& view : wrong.lights[0].views) {
            view.used = true;
            view.near_step = static_cast<int>(random.number(-40.0, 40.0));
            view.far_step = static_cast<int>(random.number(-40.0, 40.0));
            view.low = {random.number(-2.0, 1.0), random.number(-2.0, 1.0)};
            view.high = view.low + glm::dvec2(random.number(-0.5, 3.0), random.number(-0.5, 3.0));
        }
        wrong.lights[0].views[0].far_step = std::numeric_limits<int>::max();
        wrong.lights[0].views[1].near_step = std::numeric_limits<int>::min();
        wrong.lights[0].views[2].low = glm::dvec2(std::numeric_limits<double>::quiet_NaN());
        const ShadowFrame free = fitted(scene), bound = fitted(scene, wrong);
        // A view that stays wider may contain a caster where the free one has none, and so be drawn.
        more += bound.fitted.views.size() - free.fitted.views.size();
        for (const ShadowView& a : free.fitted.views) {
            const auto same = [&](const ShadowView& other) { return other.layer == a.layer; };
            const auto found = std::find_if(bound.fitted.views.begin(), bound.fitted.views.end(), same);
            ASSERT_NE(found, bound.fitted.views.end()) << "round " << round << ", view " << a.layer;
            const ShadowView& b = *found;
            const double worst = step_size(kHoldSteps + 1) * (1.0 + 1.0 / 15.0);
            EXPECT_LE(b.depth.far_m, a.depth.far_m * worst);
            EXPECT_LE(b.plane.texel_u, a.plane.texel_u * worst);
            EXPECT_LE(b.plane.texel_v, a.plane.texel_v * worst);
            ++compared;
        }
    }
    EXPECT_GT(compared, 100u);
    EXPECT_LE(more, compared / 20) << "wrong histories cost views";
}

TEST(LocalFit, OnlyFacesWithAReceiverAndACasterAreViews) {
    SceneSnapshot s = stage(LightKind::point);
    s.consumers[0].position_ws_m = {0.0, 5.0, 30.0};
    const auto through = [&](std::uint32_t face, double distance_m) {
        return s.lights[0].position_ws_m - cube_turn() * cube_face(face).axis_back * distance_m;
    };
    const auto add_pair = [&](std::uint32_t face) {
        s.instances.push_back(instance(box(through(face, 4.0), 0.5), false));
        s.instances.push_back(instance(box(through(face, 2.0), 0.3), true));
    };
    add_pair(0);
    add_pair(3);
    s.instances.push_back(instance(box(through(1, 4.0), 0.5), false));  // no caster
    s.instances.push_back(instance(box(through(2, 2.0), 0.3), true));   // nothing behind
    s.instances.back().receives = false;
    s.lights[0].shadow.filter = ShadowFilter::hard;
    ShadowFrame frame = fitted(s);
    ASSERT_EQ(frame.fitted.views.size(), 2u);
    EXPECT_EQ(frame.fitted.views[0].layer, 0u);
    EXPECT_EQ(frame.fitted.views[1].layer, 3u);
    EXPECT_EQ(frame.fitted.views[0].depth.near_m, frame.fitted.views[1].depth.near_m) << "taps may cross seams";

    s.lights[0].shadow.filter = ShadowFilter::pcf_grid;
    frame = fitted(s);
    ASSERT_EQ(frame.fitted.views.size(), 3u) << "a filter reads across the seam of what is seen and has no caster";
    EXPECT_EQ(frame.fitted.views[1].layer, 1u);
    EXPECT_EQ(frame.fitted.views[1].casters.count, 0u);
}

TEST(LocalFit, NothingBetweenLightAndReceiversIsNoViewAndSaysSo) {
    SceneSnapshot s = stage(LightKind::spot);
    s.instances.push_back(instance(box({0.8, 0.0, 0.5}, 0.3), false));
    s.instances.push_back(instance(box({-0.8, 1.0, -0.4}, 0.2), true));
    s.instances.back().receives = false;
    const ShadowFrame frame = fitted(s);
    EXPECT_TRUE(frame.fitted.views.empty());
    EXPECT_EQ(frame.statuses[0].skipped(), Reason::no_caster);
}

TEST(SpotCubeTransition, FacesComeAt122DegreesAndGoAt117AnEighthPerFrame) {
    SpotCubeTransition fade = next_spot_cube_transition(50.0 * kDegree, {});
    EXPECT_EQ(fade.cube_blend_eighths, 0);
    EXPECT_EQ(next_spot_cube_transition(61.0 * kDegree, fade).cube_blend_eighths, 0) << "within the hysteresis";
    int frames = 0;
    while (fade.cube_blend_eighths < 8 && frames < 20) {
        const int before = fade.cube_blend_eighths;
        fade = next_spot_cube_transition(61.5 * kDegree, fade);
        EXPECT_EQ(fade.cube_blend_eighths, before + 1);
        ++frames;
    }
    EXPECT_EQ(frames, 8);
    EXPECT_EQ(next_spot_cube_transition(59.0 * kDegree, fade).cube_blend_eighths, 8);
    EXPECT_EQ(next_spot_cube_transition(58.5 * kDegree, fade).cube_blend_eighths, 7);
    EXPECT_EQ(next_spot_cube_transition(61.0 * kDegree, {}).cube_blend_eighths, 8) << "a new light does not fade";
    EXPECT_EQ(next_spot_cube_transition(85.0 * kDegree, SpotCubeTransition{true, false, 0}).cube_blend_eighths, 8)
        << "no single view could hold it";
}

TEST(SpotCubeTransition, WhileItFadesBothKindsOfViewsAreThereAndLayersAreFixed) {
    SceneSnapshot s = floor_and_posts(LightKind::spot, 55.0 * kDegree);
    ShadowFrame frame = fitted(s);
    ASSERT_EQ(frame.fitted.views.size(), 1u);
    EXPECT_EQ(frame.fitted.lights[0].request.map.view_count, 1u);
    s.lights[0].outer_cone_rad = 65.0 * kDegree;
    for (int i = 1; i < 8; ++i) {
        frame = fitted(s, History(frame.next_history));
        EXPECT_EQ(frame.fitted.lights[0].request.projection.cube_blend_eighths, i);
        EXPECT_EQ(frame.fitted.lights[0].request.map.view_count, kConeFaces + 1);
        ASSERT_GE(frame.fitted.views.size(), 2u);
        EXPECT_EQ(frame.fitted.views.front().layer, 0u);
        EXPECT_EQ(frame.fitted.views.back().layer, kSingleView);
    }
    frame = fitted(s, History(frame.next_history));
    EXPECT_EQ(frame.fitted.lights[0].request.map.view_count, kConeFaces);
    EXPECT_LT(frame.fitted.views.back().layer, kSingleView);
}

TEST(Steps, BoundTheirSizesAndAreExactUnderPowersOfTwo) {
    RandomScene random(print_seed());
    for (int i = 0; i < 10000; ++i) {
        const double size = std::exp2(random.number(-300.0, 300.0));
        const int above = step_at_or_above(size), below = step_at_or_below(size);
        EXPECT_GE(step_size(above), size);
        EXPECT_LT(step_size(above - 1), size);
        EXPECT_LE(step_size(below), size);
        EXPECT_GT(step_size(below + 1), size);
        EXPECT_EQ(step_at_or_above(size * 0x1p-13), above - 13 * kStepsPerOctave);
        EXPECT_EQ(step_size(above + 26 * kStepsPerOctave), step_size(above) * 0x1p26);
    }
    EXPECT_EQ(step_at_or_above(2.0), 4);
    EXPECT_EQ(step_at_or_below(2.0), 4);
}

TEST(Steps, AreHeldUntilTooSmallOrMuchTooLarge) {
    EXPECT_EQ(hold_above(1.5, false, 0, 2), 3);
    EXPECT_EQ(hold_above(1.5, true, 5, 2), 5);
    EXPECT_EQ(hold_above(1.5, true, 6, 2), 3);
    EXPECT_EQ(hold_above(1.5, true, 2, 2), 3);
    EXPECT_EQ(hold_below(1.5, true, 0, 2), 0);
    EXPECT_EQ(hold_below(1.5, true, -1, 2), 2);
    EXPECT_EQ(hold_below(1.5, true, 3, 2), 2);
}

TEST(LocalFit, D16AndD24StepsAreTwentyTimesFinerThanFromACentimetreToTheRange) {
    RandomScene random(print_seed());
    std::vector<double> gains;
    int scenes = 0;
    for (int round = 0; round < 1400; ++round) {
        SceneSnapshot scene = random.scene(round % 2 == 0 ? LightKind::spot : LightKind::point);
        if (scene.lights[0].range_m == 0.0) continue;  // three of ten
        ++scenes;
        for (const ShadowView& view : fitted(scene).fitted.views) {
            const double z_m = view.depth.far_m;
            gains.push_back(depth_step_m(1.0, 0.01, scene.lights[0].range_m, z_m) /
                            depth_step_m(1.0, view.depth.near_m, view.depth.far_m, z_m));
        }
    }
    EXPECT_GE(scenes, 900);
    RecordProperty("median_gain", std::to_string(median(gains)));
    EXPECT_GE(median(gains), 20.0);
}

TEST(LocalFit, ReversedFloatDepthTellsApartWhatIsTwoRoundingsOfItsDistanceApart) {
    constexpr double kUnitRoundoff = 0x1p-24;
    RandomScene random(print_seed());
    int points = 0;
    for (int round = 0; round < 200; ++round) {
        for (const ShadowView& view : fitted(random.scene(round % 2 == 0 ? LightKind::spot : LightKind::point)).fitted.views) {
            for (int i = 0; i < 20; ++i) {
                const double z_m = view.depth.near_m * std::pow(view.depth.far_m / view.depth.near_m, random.number(0.0, 0.999));
                const auto stored = static_cast<float>(view.depth.alpha + view.depth.beta / z_m);
                const double quantum = static_cast<double>(stored) - static_cast<double>(std::nextafter(stored, 0.0f));
                EXPECT_LE(quantum * z_m * z_m / view.depth.beta, 2.0 * kUnitRoundoff * z_m);
                ++points;
            }
        }
    }
    EXPECT_GT(points, 1000);
}

}  // namespace
}  // namespace gnomon::shadow
