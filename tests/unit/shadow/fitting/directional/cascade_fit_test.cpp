#include "systems/shadow/fitting/directional/cascade_fit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "systems/shadow/fitting/directional/slice_sphere.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/filter_settings.h"
#include "tests/unit/shadow/fitting/directional/cascade_waste.h"
#include "tests/unit/shadow/in_map.h"
#include "tests/unit/shadow/random_scene.h"

/// What each ShadowFit promises.
namespace gnomon::shadow {
namespace {

bool holds(const ShadowView& view, const glm::dvec3& p_ws, double margin) {
    const glm::dvec3 q = in_map(view, p_ws);
    return q.x >= margin && q.y >= margin && q.x <= 1.0 - margin && q.y <= 1.0 - margin && q.z >= 0.0 && q.z <= 1.0;
}

double distance_of(const SceneSnapshot& scene, const glm::dvec3& p_ws) {
    const ConsumerItem& c = scene.consumers[0];
    return -glm::dot(p_ws - c.position_ws_m, c.rotation_ws[2]);
}

class CascadeFitTest : public ::testing::TestWithParam<ShadowFit> {
protected:
    SceneSnapshot scene_of(RandomScene& random) {
        SceneSnapshot scene = random.scene(LightKind::directional);
        scene.lights[0].tuning.cascades.fit = GetParam();
        return scene;
    }
};

TEST_P(CascadeFitTest, EveryVisiblePointLiesInTheCascadeThatServesItAndInTheOneItFadesInto) {
    RandomScene random(print_seed());
    LightItem grid;
    grid.shadow.filter = ShadowFilter::pcf_grid;
    const double margin = static_cast<double>(filter_settings(grid, 512).widest_texel) / 512.0;
    int points = 0, fading = 0;
    for (int round = 0; round < 150; ++round) {
        SceneSnapshot scene = scene_of(random);
        scene.lights[0].shadow.cascades = 1 + static_cast<std::uint32_t>(round) % 8;
        ShadowTuning::Cascades& tuning = scene.lights[0].tuning.cascades;
        tuning.splits = static_cast<CascadeSplits>(round % 6);
        tuning.split_m = {12.0f, 16.0f, 20.0f};
        tuning.blend = 0.2f;
        const ShadowFrame frame = fitted(scene);
        if (frame.fitted.views.empty()) continue;
        for (const InstanceItem& receiver : scene.instances)
            for (int k = 0; k < 10; ++k) {
                const glm::dvec3 p = random_point(random, receiver.bounds_ws);
                if (!receiver.visible || !receiver.receives || !seen(scene.consumers[0], p)) continue;
                ++points;
                if (GetParam() == ShadowFit::tight) {
                    EXPECT_TRUE(std::any_of(frame.fitted.views.begin(), frame.fitted.views.end(),
                                            [&](const ShadowView& v) { return holds(v, p, margin); }));
                    continue;
                }
                const double distance_m = distance_of(scene, p);
                std::size_t i = 0;
                while (i + 1 < frame.fitted.views.size() && distance_m > frame.fitted.views[i].cascade.seen_to_m) ++i;
                EXPECT_TRUE(holds(frame.fitted.views[i], p, margin)) << "round " << round << ", cascade " << i;
                if (i + 1 == frame.fitted.views.size()) continue;
                if (!(distance_m > frame.fitted.views[i].cascade.fades_from_m)) continue;
                EXPECT_EQ(frame.fitted.views[i + 1].layer, frame.fitted.views[i].layer + 1) << "nothing is seen beyond";
                ++fading;
                EXPECT_TRUE(holds(frame.fitted.views[i + 1], p, margin)) << "round " << round << ", beyond cascade " << i;
            }
    }
    EXPECT_GT(points, 500);
    if (GetParam() != ShadowFit::tight) {
        EXPECT_GT(fading, 20);
    }
}

TEST_P(CascadeFitTest, AHistoryOfAnythingLosesNoPoint) {
    RandomScene random(print_seed());
    LightItem grid;
    grid.shadow.filter = ShadowFilter::pcf_grid;
    const double margin = static_cast<double>(filter_settings(grid, 512).widest_texel) / 512.0;
    History history;
    int points = 0;
    for (int round = 0; round < 100; ++round) {
        const SceneSnapshot scene = scene_of(random);  // another world, light and camera each time
        const ShadowFrame frame = fitted(scene, history);
        history = frame.next_history;
        if (frame.fitted.views.empty()) continue;  // no caster can darken what is seen
        for (const glm::dvec3& p : frame.sets.receiver_points_ws) {
            ++points;
            EXPECT_TRUE(std::any_of(frame.fitted.views.begin(), frame.fitted.views.end(),
                                    [&](const ShadowView& v) { return holds(v, p, margin * 0.5); }))
                << "round " << round << " at " << distance_of(scene, p) << " m of "
                << frame.fitted.views.front().cascade.seen_from_m << " to " << frame.fitted.views.back().cascade.seen_to_m;
        }
    }
    EXPECT_GT(points, 500);
}

TEST_P(CascadeFitTest, CascadesAreAsManyAsAskedForAndAtMostEight) {
    RandomScene random(5);
    SceneSnapshot scene = scene_of(random);
    for (const std::uint32_t count : {1u, 3u, 8u}) {
        scene.lights[0].shadow.cascades = count;
        const ShadowFrame frame = fitted(scene);
        EXPECT_EQ(frame.fitted.lights[0].request.map.view_count, count);
        EXPECT_LE(frame.fitted.views.size(), count);
        EXPECT_EQ(frame.fitted.lights[0].request.note, Reason::none);
    }
    scene.lights[0].shadow.cascades = 9;
    EXPECT_EQ(fitted(scene).fitted.lights[0].request.note, Reason::cascades_clamped);
    EXPECT_EQ(fitted(scene).fitted.lights[0].request.map.view_count, 8u);
    scene.lights[0].shadow.cascades = 2;
    scene.lights[0].tuning.cascades.splits = CascadeSplits::manual;
    EXPECT_EQ(fitted(scene).fitted.lights[0].request.note, Reason::splits_invalid) << "no distance is given";
}

INSTANTIATE_TEST_SUITE_P(
    EachMode, CascadeFitTest, ::testing::Values(ShadowFit::tight, ShadowFit::stable, ShadowFit::quantised),
    [](const auto& param) {
        const ShadowFit mode = param.param;
        return std::string(mode == ShadowFit::tight ? "tight" : mode == ShadowFit::stable ? "stable" : "quantised");
    });

double median_waste(ShadowFit mode) {
    RandomScene random(20260101);
    std::vector<double> wastes;
    for (int round = 0; round < 1000; ++round) {
        SceneSnapshot scene = random.scene(LightKind::directional);
        scene.lights[0].tuning.cascades.fit = mode;
        const ShadowFrame frame = fitted(scene);
        for (const ShadowView& view : frame.fitted.views) wastes.push_back(waste(scene, frame, view));
    }
    const double middle = median(wastes);
    ::testing::Test::RecordProperty("median_waste_percent", static_cast<int>(middle * 100.0));
    return middle;
}

TEST(CascadeWaste, OfATightFitIsNothingWorthMentioning) { EXPECT_LE(median_waste(ShadowFit::tight), 0.05); }

TEST(CascadeWaste, OfAQuantisedFitIsAtMostAThird) {
    const double middle = median_waste(ShadowFit::quantised);
    EXPECT_LE(middle, 0.35);
    EXPECT_GT(middle, 0.05) << "or it is not quantised";
}

TEST(CascadeWaste, AStableMapIsItsSphereAndAPlaceToMove) {
    RandomScene random(print_seed());
    for (int round = 0; round < 300; ++round) {
        SceneSnapshot scene = random.scene(LightKind::directional);
        scene.lights[0].tuning.cascades.fit = ShadowFit::stable;
        const ShadowFrame frame = fitted(scene);
        for (std::size_t v = 0; v < frame.fitted.views.size(); ++v) {
            const ShadowView& view = frame.fitted.views[v];
            // Before a slice without receivers, a view serves farther than its own slice.
            if (v + 1 < frame.fitted.views.size() && frame.fitted.views[v + 1].layer != view.layer + 1) continue;
            const SliceSphere sphere = slice_sphere(scene.consumers[0], view.cascade.seen_from_m, view.cascade.seen_to_m);
            const double border = 1.0 - 2.0 * 4.0 / 512.0, place = 31.0 / 32.0;
            EXPECT_NEAR(view.plane.half_extent_m.x * border * place / sphere.radius_m, 1.0, 1e-3);
            EXPECT_EQ(view.plane.half_extent_m.x, view.plane.half_extent_m.y);
        }
    }
}

/// Makes a wide ground and some boxes, a sun, and a camera that looks along the ground.
SceneSnapshot street(ShadowFit mode) {
    RandomScene random(77);
    SceneSnapshot scene = random.scene(LightKind::directional, 40);
    for (InstanceItem& item : scene.instances) item.casts = item.receives = item.visible = true;
    scene.instances[0].bounds_ws = {{-60.0, -1.0, -60.0}, {60.0, 0.0, 60.0}};
    scene.consumers[0].position_ws_m = {0.0, 1.7, 0.0};
    scene.consumers[0].rotation_ws = math::basis_from_back({0.3, 0.1, 1.0});
    scene.consumers[0].fov_y_rad = 0.9;
    scene.lights[0].rotation_ws = math::basis_from_back({0.4, 1.0, -0.3});
    scene.lights[0].tuning.cascades.fit = mode;
    scene.lights[0].shadow.resolution_px = 1024;
    return scene;
}

glm::dmat3 turned(double yaw_rad, double roll_rad) {
    const glm::dmat3 base = math::basis_from_back({0.3, 0.1, 1.0});
    const auto about = [](double a, int from, int to) {
        glm::dmat3 m(1.0);
        m[from][from] = m[to][to] = std::cos(a);
        m[from][to] = std::sin(a);
        m[to][from] = -std::sin(a);
        return m;
    };
    return about(yaw_rad, 2, 0) * base * about(roll_rad, 0, 1);
}

bool same_pictures(const ShadowFrame& a, const ShadowFrame& b) {
    if (a.fitted.views.size() != b.fitted.views.size()) return false;
    for (std::size_t v = 0; v < a.fitted.views.size(); ++v)
        if (a.fitted.views[v].clip_from_anchor != b.fitted.views[v].clip_from_anchor ||
            a.fitted.views[v].pose.anchor_ws_m != b.fitted.views[v].pose.anchor_ws_m)
            return false;
    return true;
}

TEST(StableFit, RollChangesNoBit) {
    SceneSnapshot scene = street(ShadowFit::stable);
    History history;
    ShadowFrame first = fitted(scene, history);
    ASSERT_GE(first.fitted.views.size(), 3u);
    history = first.next_history;
    for (int step = 1; step <= 300; ++step) {
        scene.consumers[0].rotation_ws = turned(0.0, 2.0 * 3.14159265358979 * step / 300.0);
        const ShadowFrame rolled = fitted(scene, history);
        // Rolled far enough, another slice may have no receiver. Views that both frames have are the same.
        for (const ShadowView& view : rolled.fitted.views)
            for (const ShadowView& start : first.fitted.views) {
                if (view.layer != start.layer) continue;
                EXPECT_EQ(view.clip_from_anchor, start.clip_from_anchor) << "step " << step;
                EXPECT_EQ(view.pose.anchor_ws_m, start.pose.anchor_ws_m);
            }
        history = rolled.next_history;
    }
}

/// Numbers of views along a walk with a pan: those with another picture, and those with another size or depth range.
/// Parted: shifts of a picture by a part of a texel.
struct Moves {
    int pictures = 0, steps = 0, parted = 0;
};
Moves moves_along(ShadowFit mode, double speed_m, double pan_rad) {
    SceneSnapshot scene = street(mode);
    History history;
    ShadowFrame last;
    Moves moves;
    for (int i = 0; i < 300; ++i) {
        scene.consumers[0].position_ws_m = {0.0, 1.7, -speed_m * i};
        scene.consumers[0].rotation_ws = turned(pan_rad * i, 0.0);
        ShadowFrame frame = fitted(scene, history);
        history = frame.next_history;
        for (const ShadowView& view : frame.fitted.views)
            for (const ShadowView& before : last.fitted.views) {
                if (view.layer != before.layer) continue;
                const bool moved =
                    view.clip_from_anchor != before.clip_from_anchor || view.pose.anchor_ws_m != before.pose.anchor_ws_m;
                const bool stepped = view.plane.texel_u != before.plane.texel_u || view.plane.texel_v != before.plane.texel_v ||
                                     std::abs((view.depth.far_m - view.depth.near_m) - (before.depth.far_m - before.depth.near_m)) > 1e-9;
                moves.pictures += moved ? 1 : 0;
                moves.steps += stepped ? 1 : 0;
                if (!moved || stepped) continue;
                // On the texels of the world: shifted by whole ones.
                const glm::dvec3 shift = view.pose.anchor_ws_m - before.pose.anchor_ws_m;
                const double u =
                    (glm::dot(shift, view.pose.axis_u) + view.plane.centre_ls_m.x - before.plane.centre_ls_m.x) / view.plane.texel_u;
                const double v =
                    (glm::dot(shift, view.pose.axis_v) + view.plane.centre_ls_m.y - before.plane.centre_ls_m.y) / view.plane.texel_v;
                moves.parted += std::abs(u - std::round(u)) > 1e-6 || std::abs(v - std::round(v)) > 1e-6 ? 1 : 0;
            }
        last = std::move(frame);
    }
    return moves;
}

TEST(StableFit, AWalkAndAPanShiftMapsByWholeTexelsAndNothingElse) {
    const Moves moves = moves_along(ShadowFit::stable, 0.02, 0.004);
    EXPECT_EQ(moves.steps, 0);
    EXPECT_EQ(moves.parted, 0);
    EXPECT_LT(moves.pictures, 300 * 4 / 2) << "most frames keep most maps";
    EXPECT_GT(moves.pictures, 0);
}

TEST(StableFit, AStepWithinATexelMovesNothing) {
    SceneSnapshot scene = street(ShadowFit::stable);
    const ShadowFrame here = fitted(scene);
    double least_texel_m = 1e9;
    for (const ShadowView& view : here.fitted.views) least_texel_m = std::min(least_texel_m, view.plane.texel_u);
    scene.consumers[0].position_ws_m += glm::dvec3(0.3, 0.1, -0.2) * least_texel_m;
    EXPECT_TRUE(same_pictures(here, fitted(scene, here.next_history)));
    scene.consumers[0].position_ws_m += glm::dvec3(30.0, 0.0, 0.0);
    EXPECT_FALSE(same_pictures(here, fitted(scene, here.next_history))) << "and a long way does";
}

TEST(QuantisedFit, AWalkShiftsMapsByWholeTexelsBetweenFewSteps) {
    const Moves moves = moves_along(ShadowFit::quantised, 0.02, 0.0);
    EXPECT_LE(moves.steps, 4);
    EXPECT_EQ(moves.parted, 0);
    EXPECT_LT(moves.pictures, 300 * 4 / 4) << "most frames keep most maps";
    const Moves tight = moves_along(ShadowFit::tight, 0.02, 0.0);
    EXPECT_GT(tight.pictures, 300) << "a tight fit moves in nearly every frame";
}

TEST(QuantisedFit, AStillCameraMovesNothing) {
    const SceneSnapshot scene = street(ShadowFit::quantised);
    const ShadowFrame first = fitted(scene);
    EXPECT_TRUE(same_pictures(first, fitted(scene, first.next_history)));
    EXPECT_EQ(first.next_history, fitted(scene, first.next_history).next_history);
}

/// A sun above two boxes that change their size, before a camera far away.
class QuantisedSize : public ::testing::Test {
protected:
    void SetUp() override {
        scene_.instances.resize(2);
        scene_.consumers[0].position_ws_m = {0.0, 0.0, 200.0};
        scene_.consumers[0].rotation_ws = glm::dmat3(1.0);
        scene_.lights[0].shadow.cascades = 1;
    }
    /// Returns half of the map's extent in the next frame, with boxes of half size `half_m`.
    double extent_m(double half_m, History& previous) {
        for (InstanceItem& item : scene_.instances) item.bounds_ws = {glm::dvec3(-half_m), glm::dvec3(half_m)};
        const ShadowFrame frame = fitted(scene_, previous);
        previous = frame.next_history;
        return frame.fitted.views.at(0).plane.half_extent_m.x;
    }
    double extent_alone_m(double half_m) {
        History none;
        return extent_m(half_m, none);
    }
    /// Checks that a new map has at most two steps of headroom, for a camera that goes on turning.
    void expect_replaced(double extent, double half_m) {
        EXPECT_GE(extent / extent_alone_m(half_m), 1.0);
        EXPECT_LE(extent / extent_alone_m(half_m), 1.42);
    }
    SceneSnapshot scene_ = street(ShadowFit::quantised);
};

TEST_F(QuantisedSize, ThatIsALittleTooLargeStaysOneMuchTooLargeDoesNotAndGrowthIsFollowedAtOnce) {
    History history;
    const double wide = extent_m(20.0, history);
    for (std::uint32_t i = 0; i < 3 * kSpareFrames; ++i) EXPECT_EQ(extent_m(17.0, history), wide);
    EXPECT_GT(extent_m(30.0, history), wide);
    History far = {};
    (void)extent_m(20.0, far);
    expect_replaced(extent_m(2.0, far), 2.0);
}

TEST_F(QuantisedSize, ThatIsFourTimesTooLargeStaysForASecond) {
    History history;
    const double wide = extent_m(20.0, history);
    for (std::uint32_t i = 1; i < kSpareFrames; ++i) ASSERT_EQ(extent_m(5.0, history), wide) << i;
    expect_replaced(extent_m(5.0, history), 5.0);
    // A glance in between begins the second again.
    (void)extent_m(20.0, history);
    const double again = extent_m(20.0, history);
    for (std::uint32_t i = 0; i < 3 * kSpareFrames; ++i)
        ASSERT_EQ(extent_m(i % 50 == 0 ? 20.0 : 5.0, history), again) << i;
}

TEST_F(QuantisedSize, BecomesNotSmallerForASecondAfterAStep) {
    History history;
    (void)extent_m(20.0, history);
    const double wide = extent_m(60.0, history);
    std::uint32_t waited = 0;
    while (extent_m(2.0, history) == wide) ASSERT_LE(++waited, kSpareFrames);
    EXPECT_GE(waited, kSpareFrames - 1);
    expect_replaced(extent_m(2.0, history), 2.0);
}

}  // namespace
}  // namespace gnomon::shadow
