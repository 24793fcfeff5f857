#include "systems/shadow/culling/inner_receivers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "systems/extract/scene_tree.h"
#include "tests/oracle/fit_stages.h"
#include "tests/unit/not_finite.h"
#include "tests/unit/shadow/random_scene.h"

/// Sets and fits of many receivers, where only some are clipped.
namespace gnomon::shadow {
namespace {

constexpr std::size_t kBoxes = 12000;

/// Returns many visible receivers around a camera that looks at most of them.
SceneSnapshot crowd(RandomScene& random, LightKind kind) {
    SceneSnapshot scene = random.scene(kind, kBoxes);
    for (InstanceItem& item : scene.instances) {
        item.visible = item.receives = true;
        const glm::dvec3 half = 0.05 * glm::abs(random.vector(1.0)) + 0.01, centre = math::centre(item.bounds_ws);
        item.bounds_ws = {centre - half, centre + half};
    }
    scene.lights[0].range_m = scene.lights[0].range_m > 0.0 ? 25.0 : 0.0;
    scene.version = 1;
    build_tree(scene);
    scene.tree_version = scene.version;
    return scene;
}

/// Returns the scene without a tree: all receivers are clipped.
SceneSnapshot without_tree(SceneSnapshot scene) {
    ++scene.version;
    return scene;
}

class InnerReceivers : public ::testing::TestWithParam<LightKind> {};

TEST_P(InnerReceivers, FitsAreThoseOfAllReceiversClipped) {
    RandomScene random(print_seed());
    std::size_t clipped = 0, kept = 0;
    for (int round = 0; round < 6; ++round) {
        const SceneSnapshot scene = crowd(random, GetParam());
        ASSERT_TRUE(has_tree(scene));
        const ShadowFrame all = fitted(without_tree(scene)), some = fitted(scene);
        ASSERT_EQ(some.sets.receiver_items, all.sets.receiver_items);
        EXPECT_EQ(some.sets.caster_items, all.sets.caster_items);
        ASSERT_EQ(some.sets.hulls.size(), all.sets.hulls.size());
        for (std::size_t h = 0; h < all.sets.hulls.size(); ++h) {
            EXPECT_EQ(some.sets.hulls[h].receivers, all.sets.hulls[h].receivers);
            EXPECT_EQ(some.sets.hulls[h].consumers, all.sets.hulls[h].consumers);
        }
        ASSERT_EQ(some.fitted.views.size(), all.fitted.views.size());
        for (std::size_t v = 0; v < all.fitted.views.size(); ++v) {
            const ShadowView &one = some.fitted.views[v], &other = all.fitted.views[v];
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 4; ++row)
                    EXPECT_NEAR(one.clip_from_anchor[column][row], other.clip_from_anchor[column][row],
                                1e-5 * std::abs(other.clip_from_anchor[column][row]) + 1e-6);
            // Corners outside of a view do not count. Where several views lie side by side, other corners do than of
            // all receivers, and so other texels along the views' border.
            const bool beside = GetParam() != LightKind::directional && all.fitted.views.size() > 1;
            const double least = beside ? 0.99 : 1.0 - 1e-9;
            EXPECT_LE(one.error.extent_px, other.error.extent_px * (1.0 + 1e-9));
            EXPECT_GE(one.error.extent_px, other.error.extent_px * least);
            EXPECT_LE(one.error.texel_m, other.error.texel_m * (1.0 + 1e-9));
            EXPECT_GE(one.error.texel_m, other.error.texel_m * least);
            EXPECT_EQ(one.receivers, other.receivers);
            const auto lists = [](const FittedViews& of, const ShadowView& view) {
                const auto casters = of.casters_of(view);
                return std::vector<std::uint32_t>(casters.begin(), casters.end());
            };
            EXPECT_EQ(lists(some.fitted, one), lists(all.fitted, other)) << "view " << v;
        }
        clipped += all.sets.receiver_points_ws.size();
        kept += some.sets.receiver_points_ws.size();
    }
    std::printf("%zu points in place of %zu\n", kept, clipped);
    EXPECT_LT(2 * kept, clipped) << "control: some are left out";
}

INSTANTIATE_TEST_SUITE_P(All, InnerReceivers,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point));

TEST(SplitReceivers, InnerOnesLieInTheHullOfCornersWithinTheVolume) {
    RandomScene random(print_seed());
    std::size_t inner = 0;
    for (int round = 0; round < 12; ++round) {
        const SceneSnapshot scene = crowd(random, LightKind::point);
        std::vector<std::uint32_t> wanted;
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
            if (i % 3 != 0) wanted.push_back(i);
        const math::Frustum frustum = consumer_frustum(scene.consumers[0]);
        const auto planes = math::planes_of(frustum);
        const math::Aabb limit{glm::dvec3(-6.0, -kInfinity, -8.0), glm::dvec3(7.0, 5.0, kInfinity)};
        SplitScratch scratch;
        const SplitReceivers split = split_receivers(scene, wanted, {planes, limit}, scratch);
        inner += split.inner.size();
        math::InnerHull hull;
        hull.build(split.corners_ws_m);
        std::vector<std::uint8_t> known(scene.instances.size(), 0);
        for (const std::uint32_t i : split.inner) {
            EXPECT_NE(i % 3, 0u) << "not asked for";
            const math::Aabb& box = scene.instances[i].bounds_ws;
            const glm::dvec3 rounded = 1e-9 * (box.max - box.min);  // boxes of corners touch the facets
            EXPECT_TRUE(hull.contains({box.min + rounded, box.max - rounded}));
            EXPECT_EQ(math::overlap(planes, scene.instances[i].bounds_ws), math::Overlap::inside);
            ++known[i];
        }
        EXPECT_TRUE(std::is_sorted(split.others.begin(), split.others.end()));
        for (const std::uint32_t i : split.others) ++known[i];
        std::vector<glm::dvec3> points;
        for (const std::uint32_t i : wanted) {
            EXPECT_LE(known[i], 1) << "once at most";
            const math::Aabb box = math::intersection(scene.instances[i].bounds_ws, limit);
            const std::size_t corners = known[i] > 0 ? 0 : math::clip_box(planes, box, points);
            EXPECT_EQ(corners, 0u) << "left out, though it has a part within";
        }
    }
    EXPECT_GT(inner, 5000u);
}

TEST(SplitReceivers, FewAreAllOthers) {
    RandomScene random(print_seed());
    const SceneSnapshot scene = crowd(random, LightKind::point);
    std::vector<std::uint32_t> few;
    for (std::uint32_t i = 0; i < kFewReceivers; ++i) few.push_back(i);
    const math::Frustum frustum = consumer_frustum(scene.consumers[0]);
    SplitScratch scratch;
    const SplitReceivers split = split_receivers(scene, few, {math::planes_of(frustum)}, scratch);
    EXPECT_TRUE(split.inner.empty());
    EXPECT_TRUE(split.corners_ws_m.empty());
    EXPECT_EQ(split.others.data(), few.data());
}

}  // namespace
}  // namespace gnomon::shadow
