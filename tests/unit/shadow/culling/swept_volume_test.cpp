#include "systems/shadow/culling/swept_volume.h"

#include <gtest/gtest.h>

#include <random>

#include "systems/shadow/culling/receiver_hull.h"
#include "systems/shadow/projection/light_range.h"
#include "tests/unit/math/random_seed.h"
#include "tests/unit/shadow/random_scene.h"

namespace gnomon::shadow {
namespace {

/// One box that receives, and the volume that its light passes.
class SweptVolumeTest : public ::testing::Test {
protected:
    static constexpr glm::dvec3 kLight_m{0.0, 20.0, 0.0};
    const math::Aabb receiver{glm::dvec3(-1.0, 0.0, -1.0), glm::dvec3(1.0, 0.5, 1.0)};
    // Tangents of 90 degrees, looking down.
    const LightFrustum frustum{math::basis_from_back({0.0, 1.0, 0.0}), glm::dvec2(-1.0), glm::dvec2(1.0)};
    std::vector<glm::dvec2> outlines;
    SetScratch scratch;

    SweptVolume from_sun(const glm::dvec3& back) {
        const auto points = math::corners(receiver);
        const ReceiverHull receiver_hull = directional_hull(math::basis_from_back(back), points, outlines, scratch);
        return swept_volume(receiver_hull, outlines, {}, 0.0);
    }
    SweptVolume from_lamp() {
        const auto points = math::corners(receiver);
        const ReceiverHull receiver_hull = frustum_hull(kLight_m, frustum, points, outlines, scratch);
        return swept_volume(receiver_hull, outlines, {}, 0.0);
    }
    static math::Aabb cube(const glm::dvec3& centre, double half = 0.1) { return {centre - half, centre + half}; }
    static bool touches(const SweptVolume& v, const math::Aabb& box) { return overlap(v, box) != math::Overlap::outside; }
};

TEST_F(SweptVolumeTest, OfASunReachesUpForeverAndNotBelowTheReceiver) {
    const SweptVolume v = from_sun({0.0, 1.0, 0.0});
    EXPECT_TRUE(touches(v, cube({0.9, 1e6, -0.9})));
    EXPECT_TRUE(touches(v, cube({0.0, 0.2, 0.0})));
    EXPECT_FALSE(touches(v, cube({0.0, -0.2, 0.0})));
    EXPECT_FALSE(touches(v, cube({1.2, 5.0, 0.0})));
    EXPECT_EQ(overlap(v, cube({0.0, 50.0, 0.0})), math::Overlap::inside);
}

TEST_F(SweptVolumeTest, OfASlantingSunLeavesOutWhatTheBoxAroundItWouldKeep) {
    const SweptVolume v = from_sun(glm::normalize(glm::dvec3(1.0, 1.0, 0.0)));
    EXPECT_TRUE(touches(v, cube({10.0, 10.0, 0.0})));
    EXPECT_FALSE(touches(v, cube({2.0, 10.0, 0.0}))) << "above, but not toward the sun";
    EXPECT_FALSE(touches(v, cube({10.0, 2.0, 0.0})));
    EXPECT_FALSE(touches(v, cube({-1.0, -0.8, 0.0}))) << "beyond the receiver";
}

TEST_F(SweptVolumeTest, OfALampNarrowsTowardTheLampAndEndsThere) {
    const SweptVolume v = from_lamp();
    EXPECT_TRUE(touches(v, cube({0.9, 0.6, 0.9})));
    EXPECT_TRUE(touches(v, cube({0.5, 10.0, 0.5})));
    EXPECT_FALSE(touches(v, cube({0.9, 10.0, 0.9})));
    EXPECT_TRUE(touches(v, cube(kLight_m)));
    EXPECT_FALSE(touches(v, cube(kLight_m + glm::dvec3(0.0, 0.3, 0.0)))) << "behind the lamp";
    EXPECT_FALSE(touches(v, cube({0.0, -0.5, 0.0}))) << "behind the receiver";
}

TEST_F(SweptVolumeTest, WhatIsSeenBoundsItOnTheLightsSide) {
    const auto points = math::corners(receiver);
    const ReceiverHull receiver_hull = directional_hull(math::basis_from_back(glm::normalize(glm::dvec3(1.0, 1.0, 0.0))), points, outlines, scratch);
    // A camera sees nothing left of x = -0.5, nor anything right of x = 0.5; the sun comes from the right.
    const math::Plane planes[] = {{{1.0, 0.0, 0.0}, 0.5}, {{-1.0, 0.0, 0.0}, 0.5}};
    const SweptVolume seen = swept_volume(receiver_hull, outlines, planes, 0.0), wider = swept_volume(receiver_hull, outlines, planes, 0.3);
    EXPECT_FALSE(touches(seen, cube({-0.8, 0.2, 0.0}))) << "its shadow falls to the left of what is seen";
    EXPECT_TRUE(touches(wider, cube({-0.8, 0.2, 0.0}))) << "but a filter of 0.3 m reads it";
    EXPECT_TRUE(touches(seen, cube({10.0, 10.0, 0.0}))) << "unseen itself, it still darkens";
}

TEST_F(SweptVolumeTest, FlatAndPointlikeReceiversHaveOne) {
    for (const glm::dvec3& half : {glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(1.0, 0.0, 1.0)})
        for (const bool sun : {true, false}) {
            outlines.clear();
            const auto points = math::corners({-half, half});
            const ReceiverHull receiver_hull = sun ? directional_hull(frustum.axes, points, outlines, scratch)
                                                   : frustum_hull(kLight_m, frustum, points, outlines, scratch);
            const SweptVolume v = swept_volume(receiver_hull, outlines, {}, 0.0);
            EXPECT_TRUE(touches(v, cube({0.0, 5.0, 0.0})));
            EXPECT_FALSE(touches(v, cube({2.0, 5.0, 0.0})));
            EXPECT_FALSE(touches(v, cube({0.0, 5.0, 2.0})));
        }
}

TEST_F(SweptVolumeTest, ALampOnItsReceiverLooksAllAround) {
    outlines.clear();
    const auto points = math::corners({kLight_m + glm::dvec3(-1.0, -1.0, -1.0), kLight_m + glm::dvec3(1.0, 0.0, 1.0)});
    const ReceiverHull receiver_hull = frustum_hull(kLight_m, frustum, points, outlines, scratch);
    ASSERT_EQ(receiver_hull.outline.count, 4u);
    EXPECT_TRUE(touches(swept_volume(receiver_hull, outlines, {}, 0.0), cube(kLight_m + glm::dvec3(0.85, -0.95, 0.85))));
}

TEST_F(SweptVolumeTest, PointsAtTheLampItselfAreNoReceivers) {
    const glm::dvec3 points[] = {kLight_m, kLight_m};
    const ReceiverHull receiver_hull = frustum_hull(kLight_m, frustum, points, outlines, scratch);
    EXPECT_EQ(receiver_hull.outline.count, 0u);
    EXPECT_EQ(receiver_hull.reach_m, 0.0);
}

TEST_F(SweptVolumeTest, PointsThatAreOneButForRoundingAddNoPlane) {
    const glm::dvec3 far_away(1e6, -1e6, 1e6);
    for (const bool sun : {true, false}) {
        std::uint32_t planes[2] = {};
        for (const bool twice : {false, true}) {
            outlines.clear();
            std::vector<glm::dvec3> points;
            for (const glm::dvec3& p : math::corners(receiver)) {
                points.push_back(p + far_away);
                if (twice) points.push_back(p + far_away + glm::dvec3(1.2e-10, -2.4e-10, 2.4e-10));
            }
            const ReceiverHull receiver_hull =
                sun ? directional_hull(math::basis_from_back({0.3, 1.0, 0.2}), points, outlines, scratch)
                    : frustum_hull(kLight_m + far_away, frustum, points, outlines, scratch);
            planes[twice ? 1 : 0] = swept_volume(receiver_hull, outlines, {}, 0.0).plane_count;
        }
        EXPECT_EQ(planes[0], planes[1]) << (sun ? "sun" : "lamp");
    }
}

TEST_F(SweptVolumeTest, FewBoxesThatTouchNoRayAreKept) {
    RandomScene random(print_seed());
    int kept = 0, met = 0;
    for (int round = 0; round < 400; ++round) {
        const glm::dvec3 back = random.direction();
        outlines.clear();
        const SweptVolume v = from_sun(back);
        LightItem light;
        light.kind = LightKind::directional;
        light.rotation_ws = math::basis_from_back(back);
        for (int k = 0; k < 10; ++k) {
            const math::Aabb box = cube(4.0 * back + random.vector(4.0), random.number(0.1, 1.0));
            bool any = false;
            for (int i = 0; i < 400; ++i) {
                const glm::dvec3 p = random_point(random, receiver);
                const Crossing c = crossing(box, p, source_of(light, p));
                any = any || c.from < c.to;
            }
            EXPECT_TRUE(!any || touches(v, box));
            kept += touches(v, box) ? 1 : 0;
            met += any ? 1 : 0;
        }
    }
    EXPECT_GT(met, 500);
    EXPECT_LT(kept - met, kept / 6) << "of " << kept << "; 400 rays miss some that are only grazed";
}

/// Makes a box somewhere in another one.
math::Aabb part_of(const math::Aabb& box, std::mt19937_64& random) {
    const auto share = [&] {
        std::uniform_real_distribution<double> number(0.0, 1.0);
        return glm::dvec3(number(random), number(random), number(random));
    };
    const glm::dvec3 a = glm::mix(box.min, box.max, share()), b = glm::mix(box.min, box.max, share());
    return {glm::min(a, b), glm::max(a, b)};
}

TEST_F(SweptVolumeTest, PartsOfABoxInheritWhatNeedsNoTest) {
    std::mt19937_64 random(print_seed());
    int saved = 0, misled = 0;
    for (const SweptVolume& v : {from_lamp(), from_sun(glm::normalize(glm::dvec3(1.0, 1.0, 0.0)))}) {
        const math::Aabb around{glm::dvec3(-4.0, -1.0, -4.0), glm::dvec3(6.0, 22.0, 4.0)};
        for (int round = 0; round < 20000; ++round) {
            const math::Aabb outer = part_of(around, random), inner = part_of(outer, random);
            math::OpenTests open = tests_of(v), none = 0;
            ASSERT_EQ(overlap(v, outer, open), overlap(v, outer));
            saved += open != tests_of(v) ? 1 : 0;
            ASSERT_EQ(overlap(v, inner, open), overlap(v, inner));
            misled += overlap(v, inner, none) == overlap(v, inner) ? 0 : 1;
        }
    }
    EXPECT_GT(saved, 1000);
    EXPECT_GT(misled, 1000);
}

TEST(SeenReachTest, LeavesOutWhatAllTestsLeaveOut) {
    std::mt19937_64 random(print_seed());
    int inside = 0, outside = 0, saved = 0;
    for (const LightKind kind : {LightKind::spot, LightKind::point, LightKind::rectangle}) {
        LightItem light;
        light.kind = kind;
        light.position_ws_m = {1.0, 3.0, 2.0};
        light.rotation_ws = math::basis_from_back({0.3, 1.0, 0.2});
        light.outer_cone_rad = 0.7;
        light.range_m = 6.0;
        const LightReach reach(light);
        const math::Frustum frustum = math::perspective_frustum({0.0, 1.0, 9.0}, glm::dmat3(1.0), 0.8, 0.6, 0.1, 30.0);
        const SeenReach seen(math::planes_of(frustum), reach);
        for (int round = 0; round < 20000; ++round) {
            const math::Aabb outer = part_of({glm::dvec3(-8.0), glm::dvec3(9.0)}, random);
            const math::Aabb inner = part_of(outer, random);
            const auto usual = [&](const math::Aabb& box) {
                return math::overlap(math::planes_of(frustum), box) != math::Overlap::outside &&
                       reach.overlap(box) != math::Overlap::outside;
            };
            math::OpenTests open = seen.tests();
            const math::Overlap of_outer = seen.overlap(outer, open);
            ASSERT_EQ(of_outer != math::Overlap::outside, usual(outer));
            outside += of_outer == math::Overlap::outside ? 1 : 0;
            saved += open != seen.tests() ? 1 : 0;
            if (of_outer == math::Overlap::inside) {
                ++inside;
                ASSERT_TRUE(usual(inner));
            }
            if (of_outer != math::Overlap::partial) continue;
            ASSERT_EQ(seen.overlap(inner, open) != math::Overlap::outside, usual(inner));
        }
    }
    EXPECT_GT(inside, 100);
    EXPECT_GT(outside, 1000);
    EXPECT_GT(saved, 1000);
}

}  // namespace
}  // namespace gnomon::shadow
