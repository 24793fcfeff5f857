#include "systems/shadow/sets.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/shadow/random_scene.h"

namespace gnomon::shadow {
namespace {

constexpr LightKind kKinds[] = {LightKind::directional, LightKind::spot, LightKind::point};

bool lists(std::span<const std::uint32_t> items, IndexRange range, std::uint32_t item) {
    const auto part = items.subspan(range.first, range.count);
    return std::find(part.begin(), part.end(), item) != part.end();
}

TEST(PotentialSets, HoldEveryBlockerOfEverySampledVisiblePoint) {
    RandomScene random(print_seed());
    int points = 0, blockers = 0, left_out = 0;
    for (int round = 0; round < 300; ++round) {
        const SceneSnapshot scene = random.scene(kKinds[round % 3]);
        const LightItem& light = scene.lights[0];
        const ShadowFrame frame = fitted(scene);
        const PotentialSets& sets = frame.sets.at(0);
        left_out += static_cast<int>(scene.instances.size() - sets.casters.count);
        for (std::uint32_t r = 0; r < scene.instances.size(); ++r) {
            const InstanceItem& receiver = scene.instances[r];
            if (!receiver.visible || !receiver.receives) continue;
            for (int k = 0; k < 20; ++k) {
                const glm::dvec3 p = random_point(random, receiver.bounds_ws);
                if (!seen(scene.consumers[0], p) || !reaches(light, p)) continue;
                ++points;
                EXPECT_NE(sets.skip, Reason::no_visible_receiver);
                EXPECT_TRUE(lists(frame.receiver_items, sets.receivers, r));
                for (std::uint32_t c = 0; c < scene.instances.size(); ++c) {
                    const Crossing hit = crossing(scene.instances[c].bounds_ws, p, source_of(light, p));
                    if (!scene.instances[c].casts || !(hit.from < hit.to)) continue;
                    ++blockers;
                    EXPECT_TRUE(lists(frame.caster_items, sets.casters, c)) << "round " << round << " caster " << c;
                }
            }
        }
    }
    EXPECT_GT(points, 3000);
    EXPECT_GT(blockers, 1000);
    EXPECT_GT(left_out, 1000) << "a set of everything would pass too";
}

TEST(PotentialSets, EveryViewOfALocalLightListsTheBlockersOfItsPoints) {
    RandomScene random(print_seed());
    int blockers = 0;
    for (int round = 0; round < 200; ++round) {
        const SceneSnapshot scene = random.scene(LightKind::point);
        const ShadowFrame frame = fitted(scene);
        const LightItem& light = scene.lights[0];
        for (const InstanceItem& receiver : scene.instances) {
            const glm::dvec3 p = random_point(random, receiver.bounds_ws);
            if (!receiver.visible || !receiver.receives || !seen(scene.consumers[0], p) || !reaches(light, p)) continue;
            const glm::dvec3 to = p - light.position_ws_m, size = glm::abs(to);
            const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
            const auto face = static_cast<std::uint32_t>(axis * 2 + (to[axis] < 0.0 ? 1 : 0));
            const auto view = std::find_if(frame.views.begin(), frame.views.end(), [&](const ShadowView& v) { return v.layer == face; });
            for (std::uint32_t c = 0; c < scene.instances.size(); ++c) {
                const Crossing hit = crossing(scene.instances[c].bounds_ws, p, light.position_ws_m);
                if (!scene.instances[c].casts || !(hit.from < hit.to)) continue;
                ++blockers;
                ASSERT_NE(view, frame.views.end()) << "round " << round;
                EXPECT_TRUE(lists(frame.view_caster_items, view->casters, c)) << "round " << round;
            }
        }
    }
    EXPECT_GT(blockers, 50);
}

TEST(PotentialSets, HoldNeitherUncastingNorUnreceivingNorInvisibleReceivers) {
    RandomScene random(print_seed());
    for (int round = 0; round < 100; ++round) {
        const SceneSnapshot scene = random.scene(kKinds[round % 3]);
        const ShadowFrame frame = fitted(scene);
        for (const std::uint32_t i : frame.caster_items) EXPECT_TRUE(scene.instances[i].casts);
        for (const std::uint32_t i : frame.receiver_items) EXPECT_TRUE(scene.instances[i].receives && scene.instances[i].visible);
    }
}

TEST(PotentialSets, SayWhyThereIsNothing) {
    RandomScene random(1);
    SceneSnapshot scene = random.scene(LightKind::point);
    scene.lights[0].range_m = 0.0;
    for (InstanceItem& i : scene.instances) i.casts = false;
    ASSERT_EQ(fitted(scene).sets[0].skip, Reason::no_caster);
    for (InstanceItem& i : scene.instances) i.receives = false;
    EXPECT_EQ(fitted(scene).sets[0].skip, Reason::no_visible_receiver);
    scene.lights[0].intensity = 0.0f;
    EXPECT_EQ(fitted(scene).sets[0].skip, Reason::light_off);
    EXPECT_TRUE(fitted(scene).views.empty());
}

}  // namespace
}  // namespace gnomon::shadow
