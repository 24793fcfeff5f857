#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "engine/core/workers.h"
#include "systems/shadow/frame/light_jobs.h"
#include "tests/unit/shadow/random_scene.h"

/// Lights that several threads share: what they find and fit, beside what one thread does.
namespace gnomon::shadow {
namespace {

constexpr std::size_t kThreads = 4, kLights = 5 * kLightsPerThread;
constexpr std::array kKinds = {LightKind::directional, LightKind::spot, LightKind::point};

/// Returns a scene with lights of every kind; some have no shadow, and some reach nothing.
SceneSnapshot many_lights(RandomScene& random) {
    SceneSnapshot scene = random.scene(LightKind::directional, 60);
    scene.lights.clear();
    for (std::size_t i = 0; i < kLights; ++i) {
        LightItem light = random.scene(kKinds[i % kKinds.size()], 0).lights.front();
        light.entity = {static_cast<std::uint32_t>(i + 1), 1};
        light.has_shadow = i % 11 != 5;
        light.shadow.filter = i % 2 == 0 ? kDefaultFilter : ShadowFilter::pcf_grid;
        light.shadow.resolution_px = i % 4 == 1 ? 0 : 512;  // 0: fitted in several sizes
        light.shadow.max_error_px = i % 4 == 1 ? 20.0f : 0.0f;
        if (i % 13 == 7) light.range_m = 1e-3;
        scene.lights.push_back(light);
    }
    scene.lights[3].tuning.maps.proxies = false;
    return scene;
}

template <class T>
bool same(std::span<const T> a, std::span<const T> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

void expect_same_sets(const LightSetsView& a, const LightSetsView& b) {
    EXPECT_TRUE(same(a.receivers(), b.receivers()));
    EXPECT_TRUE(same(a.casters(), b.casters()));
    EXPECT_TRUE(same(a.receiver_points_ws(), b.receiver_points_ws()));
    EXPECT_TRUE(same(a.error_points_ws(), b.error_points_ws()));
    ASSERT_EQ(a.hulls().size(), b.hulls().size());
    for (std::size_t h = 0; h < a.hulls().size(); ++h) {
        EXPECT_TRUE(same(a.outline(a.hulls()[h]), b.outline(b.hulls()[h])));
        EXPECT_EQ(a.hulls()[h].receivers, b.hulls()[h].receivers);
        EXPECT_TRUE(same(slice(a.arrays.receiver_points_ws, a.hulls()[h].receiver_points),
                         slice(b.arrays.receiver_points_ws, b.hulls()[h].receiver_points)));
    }
}

void expect_same_view(const FittedViews& a, const ShadowView& of_a, const FittedViews& b, const ShadowView& of_b) {
    EXPECT_EQ(of_a.light, of_b.light);
    EXPECT_EQ(of_a.layer, of_b.layer);
    EXPECT_EQ(of_a.clip_from_anchor, of_b.clip_from_anchor);
    EXPECT_EQ(of_a.pose.anchor_ws_m, of_b.pose.anchor_ws_m);
    EXPECT_EQ(of_a.depth.near_m, of_b.depth.near_m);
    EXPECT_EQ(of_a.error.texel_edge_px, of_b.error.texel_edge_px);
    EXPECT_EQ(of_a.error.proxy_m, of_b.error.proxy_m);
    EXPECT_EQ(of_a.static_casters, of_b.static_casters);
    EXPECT_EQ(of_a.lit, of_b.lit);
    EXPECT_TRUE(same(a.casters_of(of_a), b.casters_of(of_b)));
    EXPECT_TRUE(same(a.meshes_of(of_a), b.meshes_of(of_b)));
}

void expect_same_areas(std::span<const LitArea> a, std::span<const LitArea> b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].reach, b[i].reach);
        EXPECT_EQ(a[i].screen, b[i].screen);
        EXPECT_EQ(a[i].farthest_depth, b[i].farthest_depth);
    }
}

void expect_same(const ShadowFrame& a, const ShadowFrame& b) {
    expect_same_areas(a.sets.lit_areas, b.sets.lit_areas);
    ASSERT_EQ(a.fitted.lights.size(), b.fitted.lights.size());
    ASSERT_EQ(a.fitted.views.size(), b.fitted.views.size());
    for (std::uint32_t i = 0; i < a.fitted.lights.size(); ++i) {
        SCOPED_TRACE("light " + std::to_string(i));
        EXPECT_EQ(a.statuses[i].skipped(), b.statuses[i].skipped());
        EXPECT_EQ(a.statuses[i].degraded(), b.statuses[i].degraded());
        EXPECT_EQ(a.fitted.lights[i].fits, b.fitted.lights[i].fits);
        EXPECT_EQ(a.fitted.lights[i].resized, b.fitted.lights[i].resized);
        expect_same_sets({a.sets, a.sets.lights[i]}, {b.sets, b.sets.lights[i]});
        expect_same_sets(a.fitted.sets_of(a.sets, i), b.fitted.sets_of(b.sets, i));
        EXPECT_EQ(a.fitted.lights[i].views.count, b.fitted.lights[i].views.count);
    }
    for (std::size_t v = 0; v < a.fitted.views.size(); ++v)
        expect_same_view(a.fitted, a.fitted.views[v], b.fitted, b.fitted.views[v]);
    EXPECT_TRUE(a.next_history == b.next_history);
}

TEST(Threads, FindAndFitTheSameAsOne) {
    RandomScene random(print_seed());
    Workers workers(kThreads);
    FitStages alone, shared;
    shared.jobs = &workers;
    std::size_t views = 0, resized = 0, skipped = 0;
    for (int world = 0; world < 40; ++world) {
        SceneSnapshot scene = many_lights(random);
        for (int frame = 0; frame < 3; ++frame) {
            const History previous = frame == 0 ? History{} : alone.frame.next_history;
            for (FitStages* stages : {&alone, &shared}) {
                stages->decide(scene, previous);
                stages->select(scene);
                stages->fit(scene, previous);
            }
            expect_same(alone.frame, shared.frame);
            views += shared.frame.fitted.views.size();
            for (const FitChoice& choice : shared.frame.fitted.lights) resized += choice.resized ? 1 : 0;
            for (const LightStatus& status : shared.frame.statuses) skipped += status.is_skipped() ? 1 : 0;
            scene.consumers.front().position_ws_m += 0.1;
        }
    }
    EXPECT_GT(views, 1000u);
    EXPECT_GT(resized, 10u);
    EXPECT_GT(skipped, 50u);
}

TEST(Threads, AreLeftAloneByFewLights) {
    Workers workers(kThreads);
    EXPECT_EQ(threads_for(nullptr, 1000), 1u);
    EXPECT_EQ(threads_for(&workers, 0), 1u);
    EXPECT_EQ(threads_for(&workers, 2 * kLightsPerThread - 1), 1u);
    EXPECT_EQ(threads_for(&workers, 2 * kLightsPerThread), 2u);
    EXPECT_EQ(threads_for(&workers, 1000), kThreads);
}

}  // namespace
}  // namespace gnomon::shadow
