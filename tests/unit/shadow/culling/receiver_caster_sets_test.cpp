#include "systems/shadow/culling/receiver_caster_sets.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <iostream>

#include "systems/extract/scene_tree.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/oracle/caster_need.h"
#include "tests/oracle/fit_oracle.h"
#include "tests/unit/shadow/random_scene.h"

namespace gnomon::shadow {
namespace {

constexpr LightKind kKinds[] = {LightKind::directional, LightKind::spot, LightKind::point};

bool lists(std::span<const std::uint32_t> items, IndexRange range, std::uint32_t item) {
    const auto part = items.subspan(range.first, range.count);
    return std::find(part.begin(), part.end(), item) != part.end();
}

TEST(LightSets, HoldEveryBlockerOfEverySampledVisiblePoint) {
    RandomScene random(print_seed());
    int points = 0, blockers = 0, left_out = 0;
    for (int round = 0; round < 300; ++round) {
        const SceneSnapshot scene = random.scene(kKinds[round % 3]);
        const LightItem& light = scene.lights[0];
        const ShadowFrame frame = fitted(scene);
        const LightSets& sets = frame.fitted.lights.at(0).sets;
        left_out += static_cast<int>(scene.instances.size() - sets.casters.count);
        for (std::uint32_t r = 0; r < scene.instances.size(); ++r) {
            const InstanceItem& receiver = scene.instances[r];
            if (!receiver.visible || !receiver.receives) continue;
            for (int k = 0; k < 20; ++k) {
                const glm::dvec3 p = random_point(random, receiver.bounds_ws);
                if (!seen(scene.consumers[0], p) || !reaches(light, p)) continue;
                ++points;
                EXPECT_NE(frame.statuses.at(0).skipped(), Reason::no_visible_receiver);
                EXPECT_TRUE(lists(frame.sets.receiver_items, sets.receivers, r));
                for (std::uint32_t c = 0; c < scene.instances.size(); ++c) {
                    const Crossing hit = crossing(scene.instances[c].bounds_ws, p, source_of(light, p));
                    if (!scene.instances[c].casts || !(hit.from < hit.to)) continue;
                    ++blockers;
                    EXPECT_TRUE(lists(frame.sets.caster_items, sets.casters, c)) << "round " << round << " caster " << c;
                }
            }
        }
    }
    EXPECT_GT(points, 3000);
    EXPECT_GT(blockers, 1000);
    EXPECT_GT(left_out, 1000) << "a set of everything would pass too";
}

/// Returns where a filter's outermost tap compares instead of `p`: `texels` of its view aside, at the same depth.
oracle::Vector tap(const ShadowView& view, const glm::dvec3& p, const glm::dvec2& texels) {
    const double distance_m =
        view.projection == ViewProjection::orthographic ? 1.0 : -glm::dot(p - apex_ws_m(view), view.pose.axis_back);
    return oracle::exact(p + distance_m * (view.pose.axis_u * (texels.x * view.plane.texel_u) + view.pose.axis_v * (texels.y * view.plane.texel_v)));
}

TEST(LightSets, EveryViewListsTheBlockersOfItsPointsAndOfItsFiltersTaps) {
    RandomScene random(print_seed());
    int blockers = 0, listed = 0, all = 0;
    for (int round = 0; round < 600; ++round) {
        const SceneSnapshot scene = random.scene(kKinds[round % 3]);
        const LightItem& light = scene.lights[0];
        const ShadowFrame frame = fitted(scene);
        const double reach = static_cast<double>(frame.fitted.lights[0].request.map.filtering.widest_texel);
        for (const ShadowView& view : frame.fitted.views) {
            listed += static_cast<int>(view.casters.count);
            all += static_cast<int>(scene.instances.size());
        }
        for (const InstanceItem& receiver : scene.instances) {
            const glm::dvec3 p = random_point(random, receiver.bounds_ws);
            const oracle::Vector exact = oracle::exact(p);
            if (!receiver.visible || !receiver.receives || !oracle::sees(scene.consumers[0], exact, 1e-9L) ||
                !oracle::reaches(light, exact, 1e-9L))
                continue;
            for (const ShadowView& view : frame.fitted.views) {
                if (!oracle::holds(view, exact, light.shadow.resolution_px, reach)) continue;
                const oracle::Vector aside = tap(view, p, {random.number(-reach, reach), random.number(-reach, reach)});
                for (std::uint32_t c = 0; c < scene.instances.size(); ++c) {
                    const math::Aabb& box = scene.instances[c].bounds_ws;
                    if (!scene.instances[c].casts ||
                        !(oracle::darkens(light, box, exact, 1e-6L) || oracle::darkens(light, box, aside, 1e-6L)))
                        continue;
                    ++blockers;
                    EXPECT_TRUE(lists(frame.fitted.casters, view.casters, c)) << "round " << round;
                }
            }
        }
    }
    EXPECT_GT(blockers, 500);
    EXPECT_LT(listed, all / 3) << "lists of everything would pass too";
}

TEST(LightSets, AViewsCastersAreInOrderOfTheirMeshesAndEachIsThereOnce) {
    RandomScene random(print_seed());
    for (int round = 0; round < 60; ++round) {
        const SceneSnapshot scene = random.scene(kKinds[round % 3], round % 2 == 0 ? 24 : 3);
        const ShadowFrame frame = fitted(scene);
        for (const ShadowView& view : frame.fitted.views)
            for (std::uint32_t i = 1; i < view.casters.count; ++i) {
                const std::uint32_t a = frame.fitted.casters[view.casters.first + i - 1], b = frame.fitted.casters[view.casters.first + i];
                EXPECT_LT(std::pair(scene.instances[a].mesh, a), std::pair(scene.instances[b].mesh, b));
            }
    }
}

TEST(LightSets, AreTheSameWithATreeOfAnyShapeAsWithout) {
    RandomScene random(print_seed());
    for (int round = 0; round < 90; ++round) {
        SceneSnapshot scene = random.scene(kKinds[round % 3], 200);
        SceneSnapshot grown = random.scene(kKinds[round % 3], 200);  // a tree that has seen other places first
        build_tree(grown);
        std::swap(scene.tree, grown.tree);
        scene.tree_version = scene.version = 1;
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i) scene.changed_instances.push_back(i);
        refit_tree(scene);
        ASSERT_TRUE(has_tree(scene));
        SceneSnapshot fresh = scene, without = scene;
        build_tree(fresh);
        without.tree_version = 0;
        ASSERT_FALSE(has_tree(without));
        const ShadowFrame a = fitted(scene), b = fitted(fresh), c = fitted(without);
        for (const ShadowFrame* other : {&b, &c}) {
            EXPECT_EQ(a.sets.receiver_items, other->sets.receiver_items);
            EXPECT_EQ(a.sets.receiver_points_ws, other->sets.receiver_points_ws);
            EXPECT_EQ(a.sets.caster_items, other->sets.caster_items);
            EXPECT_EQ(a.fitted.casters, other->fitted.casters);
            EXPECT_EQ(a.sets.outlines, other->sets.outlines);
        }
    }
}

TEST(LightSets, ATreeOfAnOlderSceneIsNotUsed) {
    RandomScene random(4);
    SceneSnapshot scene = random.scene(LightKind::point, 100);
    build_tree(scene);
    const std::vector<std::uint32_t> before = fitted(scene).sets.receiver_items;
    ASSERT_FALSE(before.empty());
    // An instance out of sight moves to where another is seen: first unknown to the tree, then with a new version.
    std::uint32_t unseen = 0;
    const auto out_of_sight = [&](std::uint32_t i) {
        return scene.instances[i].visible && scene.instances[i].receives &&
               std::find(before.begin(), before.end(), i) == before.end();
    };
    while (!out_of_sight(unseen)) ++unseen;
    scene.instances[unseen].bounds_ws = scene.instances[before.front()].bounds_ws;
    EXPECT_EQ(fitted(scene).sets.receiver_items, before);
    ++scene.version;
    EXPECT_THAT(fitted(scene).sets.receiver_items, ::testing::Contains(unseen));
}

/// Counts the listed casters on the way from the light to some visible point; the others are listed in vain.
TEST(LightSets, KeepFewCastersNeedlessly) {
    RandomScene random(print_seed());
    for (const LightKind kind : kKinds) {
        int listed = 0, needed = 0;
        for (int round = 0; round < 100; ++round) {
            const SceneSnapshot scene = random.scene(kind, 60);
            const ShadowFrame frame = fitted(scene);
            const oracle::CasterNeed need = oracle::caster_need(scene, frame, 0, 60);
            listed += need.listed;
            needed += need.needed;
        }
        std::cout << light_kind_row(kind).name << ": " << listed << " casters listed by views, " << listed - needed
                  << " of them darken no sampled point\n";
        EXPECT_GT(listed, 500);
        EXPECT_GT(needed, listed / 3) << "local lights list all that their kept maps show";
    }
}

TEST(LightSets, HoldNeitherUncastingNorUnreceivingNorInvisibleReceivers) {
    RandomScene random(print_seed());
    for (int round = 0; round < 100; ++round) {
        const SceneSnapshot scene = random.scene(kKinds[round % 3]);
        const ShadowFrame frame = fitted(scene);
        for (const std::uint32_t i : frame.sets.caster_items) EXPECT_TRUE(scene.instances[i].casts);
        for (const std::uint32_t i : frame.sets.receiver_items) EXPECT_TRUE(scene.instances[i].receives && scene.instances[i].visible);
    }
}

TEST(LightSets, SayWhyThereIsNothing) {
    RandomScene random(1);
    SceneSnapshot scene = random.scene(LightKind::point);
    scene.lights[0].range_m = 0.0;
    for (InstanceItem& i : scene.instances) i.casts = false;
    ASSERT_EQ(fitted(scene).statuses[0].skipped(), Reason::no_caster);
    for (InstanceItem& i : scene.instances) i.receives = false;
    EXPECT_EQ(fitted(scene).statuses[0].skipped(), Reason::no_visible_receiver);
    scene.lights[0].intensity = 0.0f;
    EXPECT_EQ(fitted(scene).statuses[0].skipped(), Reason::light_off);
    EXPECT_TRUE(fitted(scene).fitted.views.empty());
}

}  // namespace
}  // namespace gnomon::shadow
