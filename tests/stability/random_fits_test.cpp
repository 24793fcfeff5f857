#include "tests/stability/random_fits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "engine/math/frustum.h"
#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/projection/sun_viewpoint.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/long_run.h"
#include "tests/oracle/fit_oracle.h"
#include "tests/oracle/fit_stages.h"
#include "tests/unit/math/random_seed.h"

/// Random fits by the hundred thousand, judged point by point in long double. 20 000 of each kind in a short run, 100 000
/// with GNOMON_LONG, any number with GNOMON_FITS.
namespace gnomon::shadow {
namespace {

using oracle::Real;
using oracle::Vector;

std::uint64_t fit_count() {
    constexpr std::uint64_t kShort = kSanitized ? 2000 : 20000;
    if (const char* count = std::getenv("GNOMON_FITS")) return std::strtoull(count, nullptr, 10);
    return is_long_run() ? 100000 : kShort;
}

/// Points this share inside of what is seen and lit: closer, rounding of the camera itself decides.
constexpr Real kInset = 1e-9L;
/// A ray that passes less of a box than this touches a corner: rounding decides.
constexpr Real kLeastPassage = 1e-6L;
/// Interval, in fits, at which a fit is made again elsewhere and at another size.
constexpr std::uint64_t kMoveEvery = 8;

struct Tally {
    std::uint64_t fits = 0, views = 0, skipped = 0, points = 0, dark_points = 0, blockers = 0, listed = 0;
    std::uint64_t not_finite = 0, outside = 0, missed = 0, deeper = 0, unflagged = 0;
    std::uint64_t scaled = 0, scale_differs = 0, moved = 0, move_differs = 0;
};

class RandomFitsTest : public ::testing::TestWithParam<LightKind> {
protected:
    const ShadowFrame& fit(const SampledScene& scene, ShadowFrame& frame, const History& previous = {}) {
        FitStages stages;
        stages.sampled_depths = scene.sampled_depths;
        stages.decide(scene, previous);
        stages.select(scene);
        stages.fit(scene, previous);
        frame = std::move(stages.frame);
        for (const FitChoice& light : frame.fitted.lights) most_fits = std::max(most_fits, light.fits);
        return frame;
    }

    static bool finite(const ShadowView& view) {
        bool all = std::isfinite(view.depth.near_m + view.depth.far_m + view.plane.texel_u + view.plane.texel_v + view.depth.alpha + view.depth.beta +
                                 view.error.edge_px + view.cascade.seen_from_m) && view.depth.near_m < view.depth.far_m;
        for (int i = 0; i < 3; ++i)
            all = all && std::isfinite(view.pose.anchor_ws_m[i] + view.pose.axis_u[i] + view.pose.axis_v[i] + view.pose.axis_back[i]);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                all = all && std::isfinite(view.clip_from_anchor[c][r]) && std::isfinite(view.map_from_anchor[c][r]);
        return all;
    }

    void judge_numbers(const ShadowFrame& frame) {
        tally.views += frame.fitted.views.size();
        tally.skipped += frame.fitted.views.empty() ? 1 : 0;
        for (const ShadowView& view : frame.fitted.views) tally.not_finite += finite(view) ? 0 : 1;
        if (frame.fitted.views.empty() == (frame.statuses[0].skipped() == Reason::none)) ++tally.unflagged;
    }

    /// Expects what `count` random fits must have shown.
    void expect_proven(std::uint64_t count) const {
        EXPECT_EQ(tally.not_finite, 0u);
        EXPECT_LE(most_fits, kMaxFits);
        EXPECT_EQ(tally.unflagged, 0u);
        EXPECT_EQ(tally.outside, 0u);
        EXPECT_EQ(tally.missed, 0u);
        EXPECT_EQ(tally.scale_differs, 0u);
        // Where two choices are equal within rounding, the other may be taken at another place.
        EXPECT_LE(tally.move_differs, tally.moved / 100);
        EXPECT_GT(tally.points, count / 2) << "too little is seen to prove anything";
        EXPECT_GT(tally.blockers, count / 8);
    }

    /// Draws a point of the box that the camera is likely to see. It is any point, a corner, or a point where the edge
    /// of the camera's sight meets the box.
    Vector sample(const ConsumerItem& camera, const math::Aabb& box) {
        const double which = random.number(0.0, 1.0);
        glm::dvec3 p(random.number(box.min.x, box.max.x), random.number(box.min.y, box.max.y), random.number(box.min.z, box.max.z));
        if (which < 0.5) return oracle::exact(p);
        if (which < 0.75) return oracle::exact(math::corners(box)[static_cast<std::size_t>(random.number(0.0, 8.0))]);
        // Toward the rim of the picture, as far as the sight goes before it leaves the box.
        const double tan_y = std::tan(0.5 * camera.fov_y_rad) * 0.999999;
        glm::dvec3 rim(tan_y * 640.0 / 360.0 * random.number(-1.0, 1.0), random.chance(0.5) ? tan_y : -tan_y, -1.0);
        const glm::dvec3 along = camera.rotation_ws * rim;
        double last = 1e4;
        for (int i = 0; i < 3; ++i) {
            const double side = along[i] > 0.0 ? box.max[i] : box.min[i];
            if (along[i] != 0.0) last = std::min(last, (side - camera.position_ws_m[i]) / along[i]);
        }
        const glm::dvec3 at = camera.position_ws_m + along * last;
        return oracle::exact(glm::clamp(at, box.min, box.max));
    }

    /// Returns the light as its rays come: a point light at the eye for a sun that has one, else the light itself.
    static LightItem source_of(const LightItem& light, const ShadowFrame& frame) {
        LightItem source = light;
        if (!frame.fitted.lights[0].request.projection.perspective_sun) return source;
        const IndexRange& seen = frame.fitted.lights[0].sets.receiver_points;
        if (frame.fitted.views.empty() && seen.count == 0) return source;
        source.kind = LightKind::point;
        // Without a view, since nothing casts into it, the eye is still where the view would have had it.
        source.position_ws_m =
            frame.fitted.views.empty()
                ? sun_viewpoint(math::basis_from_back(light.rotation_ws[2]),
                          std::span(frame.sets.receiver_points_ws).subspan(seen.first, seen.count), light.tuning.projection)
                      .position_ws_m
                : frame.fitted.views[0].pose.anchor_ws_m;
        source.range_m = 0.0;
        return source;
    }

    /// Returns whether a given depth range or a given eye leaves out a part of the scene. That part is lit: then only
    /// points in a view count.
    static bool leaves_out(const ShadowRequest& demand, const LightItem& light) {
        return demand.projection.near_m > 0.0 || demand.projection.far_m > 0.0 ||
               (demand.projection.perspective_sun && light.tuning.projection.eye_distance_m > 0.0f);
    }

    void judge_point(const SceneSnapshot& scene, const ShadowFrame& frame, const Vector& p) {
        const ShadowRequest& demand = frame.fitted.lights[0].request;
        const LightItem light = source_of(scene.lights[0], frame);
        const Real size_px = demand.map.resolution_px;
        const Real reach = static_cast<Real>(demand.map.filtering.widest_texel);
        const oracle::Deciding by = oracle::deciding_views(frame.fitted.views, demand, scene.consumers[0], p, reach);
        const bool in_view = by.view && oracle::holds(*by.view, p, size_px, 0);
        const bool in_single = by.single && oracle::holds(*by.single, p, size_px, 0);
        const bool partial = leaves_out(demand, scene.lights[0]);
        if (partial && !(by.wants_view && in_view) && !(by.wants_single && in_single)) return;
        ++tally.points;
        bool dark = false;
        for (std::uint32_t c = 0; c < scene.instances.size(); ++c) {
            if (!scene.instances[c].casts || !oracle::darkens(light, scene.instances[c].bounds_ws, p, kLeastPassage)) continue;
            ++tally.blockers;
            dark = true;
            if (by.wants_view && (in_view || !partial)) tally.missed += by.view && lists(frame, *by.view, c) ? 0 : 1;
            if (by.wants_single && (in_single || !partial)) tally.missed += lists(frame, *by.single, c) ? 0 : 1;
            // A cascade may fade into any later cascade with the point in its map.
            for (const ShadowView& view : frame.fitted.views)
                if (view.projection == ViewProjection::orthographic && oracle::holds(view, p, size_px, reach))
                    tally.missed += lists(frame, view, c) ? 0 : 1;
            if (frame.fitted.views.empty()) ++tally.missed;
        }
        tally.dark_points += dark ? 1 : 0;
        if (partial) return;
        // A face that casts nothing on anything may be left out; a sun's maps hold whatever is seen.
        const bool must_hold = dark || (scene.lights[0].kind == LightKind::directional && !frame.fitted.views.empty());
        if (must_hold && by.wants_view && !in_view) ++tally.outside;
        if (by.wants_single && !in_single) ++tally.outside;
    }

    static bool lists(const ShadowFrame& frame, const ShadowView& view, std::uint32_t caster) {
        const auto casters = std::span(frame.fitted.casters).subspan(view.casters.first, view.casters.count);
        return std::find(casters.begin(), casters.end(), caster) != casters.end();
    }

    void judge_points(const SceneSnapshot& scene, const ShadowFrame& frame) {
        for (const InstanceItem& receiver : scene.instances) {
            if (!receiver.visible || !receiver.receives) continue;
            for (const ConsumerItem& camera : scene.consumers)
                for (int k = 0; k < 4; ++k) {
                    const Vector p = sample(camera, receiver.bounds_ws);
                    if (oracle::sees(camera, p, kInset) && oracle::reaches(scene.lights[0], p, kInset))
                        judge_point(scene, frame, p);
                }
        }
    }

    /// Compares what must be equal, bit for bit, at 2^power times the size.
    void judge_scale(SampledScene scene, const ShadowFrame& frame, int power) {
        scale(scene, power);
        const ShadowFrame& there = fit(scene, elsewhere);
        ++tally.scaled;
        const float by = std::exp2(static_cast<float>(power));
        bool same = there.fitted.views.size() == frame.fitted.views.size() && there.sets.caster_items == frame.sets.caster_items &&
                    there.sets.receiver_items == frame.sets.receiver_items && there.fitted.casters == frame.fitted.casters;
        for (std::size_t v = 0; same && v < frame.fitted.views.size(); ++v) {
            const ShadowView &a = frame.fitted.views[v], &b = there.fitted.views[v];
            const bool flat = a.projection == ViewProjection::orthographic;
            same = b.pose.anchor_ws_m == a.pose.anchor_ws_m * std::exp2(power) && b.depth.near_m == a.depth.near_m * std::exp2(power);
            for (int c = 0; c < 4; ++c)
                for (int r = 0; r < 4; ++r) {
                    // Orthographic: columns that meet metres shrink. Perspective: the depth's constant grows.
                    const float factor = flat ? (c < 3 ? 1.0f / by : 1.0f) : (c < 3 ? 1.0f : by);
                    same = same && b.clip_from_anchor[c][r] == a.clip_from_anchor[c][r] * factor;
                }
        }
        tally.scale_differs += same ? 0 : 1;
    }

    /// Judges the scene moved elsewhere: its points, and that it has as many maps, with texels of the same size.
    void judge_move(SampledScene scene, const ShadowFrame& frame, const glm::dvec3& by_m) {
        move(scene, by_m);
        const ShadowFrame& there = fit(scene, elsewhere);
        judge_points(scene, there);
        ++tally.moved;
        bool same = there.fitted.views.size() == frame.fitted.views.size();
        for (std::size_t v = 0; same && v < frame.fitted.views.size(); ++v) {
            const ShadowView &a = frame.fitted.views[v], &b = there.fitted.views[v];
            const double area = b.plane.texel_u * b.plane.texel_v / (a.plane.texel_u * a.plane.texel_v);
            same = area > 0.999 && area < 1.001;
        }
        tally.move_differs += same ? 0 : 1;
    }

    /// Sets a sun that one camera sees, warped as much as it may be, or less.
    void warp(SceneSnapshot& scene) {
        LightItem& light = scene.lights[0];
        light.tuning.cascades.fit = ShadowFit::tight;
        light.tuning.projection.kind = LightProjection::automatic;
        light.tuning.projection.near_m = light.tuning.projection.far_m = 0.0f;
        light.shadow.cascades = random.chance(0.7) ? 1 : 3;
        light.tuning.cascades.warp = random.chance(0.5) ? 1.0f : static_cast<float>(random.number(0.05, 1.0));
        scene.consumers.resize(1);
    }

    RandomFits random{print_seed()};
    Tally tally;
    std::uint32_t most_fits = 0;
    ShadowFrame here, elsewhere;
    History past;
};

void print(const Tally& t, std::string_view kind) {
    std::cout << kind << ": " << t.fits << " fits, " << t.views << " views, " << t.skipped << " skipped; " << t.points
              << " points, " << t.dark_points << " with casters, " << t.blockers << " of those; not finite " << t.not_finite
              << ", outside " << t.outside << ", missed " << t.missed << ", unflagged " << t.unflagged << "; scaled "
              << t.scaled << ", differ " << t.scale_differs << "; moved " << t.moved << ", differ " << t.move_differs << '\n';
}

TEST_P(RandomFitsTest, HoldEveryReceiverAndEveryCasterWhateverTheScaleAndThePlace) {
    const std::uint64_t count = fit_count();
    for (std::uint64_t i = 0; i < count; ++i) {
        const SampledScene scene = random.scene(GetParam());
        ++tally.fits;
        // What another scene left behind is no worse a past than any other. Elsewhere a past would be another one.
        const bool has_past = i % kMoveEvery > 1 && random.chance(0.5);
        judge_numbers(fit(scene, here, has_past ? past : History{}));
        past = here.next_history;
        judge_points(scene, here);
        if (i % kMoveEvery == 0) judge_scale(scene, here, static_cast<int>(random.number(-13.0, 27.0)));
        if (i % kMoveEvery == 1) judge_move(scene, here, glm::round(random.vector(random.size(1.0, 0x1p25))));
    }
    print(tally, light_kind_row(GetParam()).name);
    expect_proven(count);
}

class WarpedFitsTest : public RandomFitsTest {};

TEST_P(WarpedFitsTest, HoldEveryReceiverAndEveryCasterWhateverTheScaleAndThePlace) {
    const std::uint64_t count = fit_count();
    std::uint64_t warped = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        SampledScene scene = random.scene(GetParam());
        warp(scene);
        ++tally.fits;
        judge_numbers(fit(scene, here));
        for (const ShadowView& view : here.fitted.views) warped += view.plane.warp != glm::dvec2(0.0) ? 1 : 0;
        judge_points(scene, here);
        if (i % kMoveEvery == 0) judge_scale(scene, here, static_cast<int>(random.number(-13.0, 27.0)));
        if (i % kMoveEvery == 1) judge_move(scene, here, glm::round(random.vector(random.size(1.0, 0x1p25))));
    }
    print(tally, "warped sun");
    std::cout << warped << " views are warped\n";
    expect_proven(count);
    EXPECT_GT(warped, count / 8) << "too few are warped to prove anything";
}

TEST_P(WarpedFitsTest, AnyFiniteInputGivesFiniteViewsOrAReason) {
    const std::uint64_t count = fit_count() / 4;
    for (std::uint64_t i = 0; i < count; ++i) {
        SampledScene scene = random.wild_scene(GetParam());
        warp(scene);
        judge_numbers(fit(scene, here));
    }
    EXPECT_EQ(tally.not_finite, 0u);
    EXPECT_EQ(tally.unflagged, 0u);
    EXPECT_GT(tally.views, count / 8);
}

INSTANTIATE_TEST_SUITE_P(OfASun, WarpedFitsTest, ::testing::Values(LightKind::directional));

TEST_P(RandomFitsTest, AnyFiniteInputGivesFiniteViewsOrAReason) {
    const std::uint64_t count = fit_count() / 4;
    for (std::uint64_t i = 0; i < count; ++i) {
        const SampledScene scene = random.wild_scene(GetParam());
        ++tally.fits;
        judge_numbers(fit(scene, here));
    }
    print(tally, light_kind_row(GetParam()).name);
    EXPECT_EQ(tally.not_finite, 0u);
    EXPECT_EQ(tally.unflagged, 0u);
    EXPECT_GT(tally.views, count / 8);
}

TEST_P(RandomFitsTest, AMissingCasterAndAShiftedMapAreNoticed) {
    for (int i = 0; i < 2000; ++i) {
        const SampledScene scene = random.scene(GetParam());
        fit(scene, here);
        for (ShadowView& view : here.fitted.views) {
            view.casters.count /= 2;
            for (int c = 0; c < 4; ++c) view.map_from_anchor[c][0] += view.map_from_anchor[c][3];
        }
        judge_points(scene, here);
    }
    EXPECT_GT(tally.missed, 100u);
    EXPECT_GT(tally.outside, 100u);
}

INSTANTIATE_TEST_SUITE_P(EachKind, RandomFitsTest, ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& param) { return std::string(light_kind_row(param.param).name); });

}  // namespace
}  // namespace gnomon::shadow
