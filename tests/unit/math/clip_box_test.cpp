#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "engine/math/frustum.h"
#include "tests/unit/math/random_seed.h"
#include "tests/unit/not_finite.h"

namespace gnomon::math {
namespace {

std::vector<glm::dvec3> clip(const Frustum& f, const Aabb& box) {
    std::vector<glm::dvec3> out;
    const std::size_t added = clip_box(f, box, out);
    EXPECT_EQ(added, out.size());
    return out;
}

/// Returns the points without repetition: two closer than `tolerance` count as one.
std::vector<glm::dvec3> distinct(const std::vector<glm::dvec3>& points, double tolerance) {
    std::vector<glm::dvec3> out;
    for (const glm::dvec3& p : points) {
        const bool known =
            std::any_of(out.begin(), out.end(), [&](const glm::dvec3& q) { return glm::distance(p, q) <= tolerance; });
        if (!known) out.push_back(p);
    }
    return out;
}

void expect_same_points(const std::vector<glm::dvec3>& got, const std::vector<glm::dvec3>& want, double tolerance) {
    const auto unique = distinct(got, tolerance);
    EXPECT_EQ(unique.size(), want.size());
    for (const glm::dvec3& w : want) {
        EXPECT_TRUE(std::any_of(unique.begin(), unique.end(),
                                [&](const glm::dvec3& p) { return glm::distance(p, w) <= tolerance; }))
            << "missing " << w.x << ' ' << w.y << ' ' << w.z;
    }
}

const Frustum kSlab = orthographic_frustum(glm::dvec3(0.0), glm::dmat3(1.0), 2.0, 2.0, 1.0, 5.0);
const Frustum kPyramid = perspective_frustum(glm::dvec3(0.0), glm::dmat3(1.0), 1.0, 1.0, 1.0, 4.0);
const std::vector<glm::dvec3> kPyramidCorners = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                                 {-4, -4, -4}, {4, -4, -4}, {-4, 4, -4}, {4, 4, -4}};

TEST(ClipBox, ABoxInsideKeepsItsEightCornersBitForBit) {
    const Aabb box{glm::dvec3(0.1, 0.2, -3.7), glm::dvec3(0.3, 0.4, -3.3)};
    const auto c = corners(box);
    EXPECT_THAT(clip(kSlab, box), ::testing::UnorderedElementsAreArray(c));
}

TEST(ClipBox, ABoxAroundABoundedFrustumGivesTheFrustumsCorners) {
    expect_same_points(clip(kPyramid, {glm::dvec3(-100.0), glm::dvec3(200.0)}), kPyramidCorners, 1e-12);
}

TEST(ClipBox, ABoxAroundAFrustumWithoutFarPlaneCutsItOff) {
    const Frustum f = perspective_frustum(glm::dvec3(0.0), glm::dmat3(1.0), 1.0, 1.0, 1.0, kInfinity);
    expect_same_points(clip(f, {glm::dvec3(-9.0, -9.0, -4.0), glm::dvec3(9.0)}), kPyramidCorners, 1e-12);
}

TEST(ClipBox, ANearPlaneThroughTheApexGivesTheApex) {
    const Frustum f = perspective_frustum(glm::dvec3(0.0), glm::dmat3(1.0), 1.0, 1.0, 0.0, 4.0);
    expect_same_points(clip(f, {glm::dvec3(-9.0), glm::dvec3(9.0)}),
                       {{0, 0, 0}, {-4, -4, -4}, {4, -4, -4}, {-4, 4, -4}, {4, 4, -4}}, 1e-12);
}

TEST(ClipBox, AFlatBoxAcrossTheFrustumGivesTheCrossSection) {
    const Aabb sheet{glm::dvec3(-9.0, -9.0, -3.0), glm::dvec3(9.0, 9.0, -3.0)};
    expect_same_points(clip(kPyramid, sheet), {{-3, -3, -3}, {3, -3, -3}, {-3, 3, -3}, {3, 3, -3}}, 1e-12);
}

TEST(ClipBox, AFlatFloorSeenAlongItsPlaneGivesATrapezium) {
    const Aabb floor{glm::dvec3(-9.0, -0.5, -9.0), glm::dvec3(9.0, -0.5, 9.0)};
    expect_same_points(clip(kPyramid, floor), {{-1, -0.5, -1}, {1, -0.5, -1}, {-4, -0.5, -4}, {4, -0.5, -4}}, 1e-12);
}

TEST(ClipBox, FlatBoxOnAFrustumPlaneKeepsItsCorners) {
    const Aabb floor{glm::dvec3(-9.0, -2.0, -9.0), glm::dvec3(9.0, -2.0, 9.0)};
    expect_same_points(clip(kSlab, floor), {{-2, -2, -1}, {2, -2, -1}, {-2, -2, -5}, {2, -2, -5}}, 1e-12);
    const Aabb near_sheet{glm::dvec3(-9.0, -9.0, -1.0), glm::dvec3(9.0, 9.0, -1.0)};
    expect_same_points(clip(kPyramid, near_sheet), {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}}, 1e-12);
}

TEST(ClipBox, ALineIsCutAtTheFrustum) {
    const Aabb line{glm::dvec3(-9.0, 0.5, -2.0), glm::dvec3(9.0, 0.5, -2.0)};
    expect_same_points(clip(kPyramid, line), {{-2, 0.5, -2}, {2, 0.5, -2}}, 1e-12);
}

TEST(ClipBox, APointIsKeptInsideAndDroppedOutside) {
    const glm::dvec3 in(0.0, 0.0, -2.0);
    const glm::dvec3 beyond(0.0, 0.0, -6.0);
    EXPECT_EQ(distinct(clip(kPyramid, {in, in}), 0.0).size(), 1u);
    EXPECT_TRUE(clip(kPyramid, {beyond, beyond}).empty());
}

TEST(ClipBox, BoxesOutsideGiveNothingEvenWhereNoSinglePlaneSeparatesThem) {
    EXPECT_TRUE(clip(kPyramid, {glm::dvec3(-1.0, -1.0, 1.0), glm::dvec3(1.0, 1.0, 2.0)}).empty());
    // Beyond an edge of the volume (at x = sqrt 2), where each plane alone keeps the box.
    const Frustum f = orthographic_frustum(glm::dvec3(0.0), basis_from_back({1.0, 0.0, 1.0}), 1.0, 1.0, -1.0, 1.0);
    const Aabb box{glm::dvec3(1.5, -0.5, -5.0), glm::dvec3(9.0, 0.5, 5.0)};
    ASSERT_TRUE(may_overlap(f, box));
    EXPECT_TRUE(clip(f, box).empty());
}

TEST(ClipBox, AppendsAndCountsOnlyWhatItAdded) {
    std::vector<glm::dvec3> out(3, glm::dvec3(7.0));
    const std::size_t added = clip_box(kPyramid, {glm::dvec3(-1.0, -1.0, -3.0), glm::dvec3(1.0, 1.0, -2.0)}, out);
    EXPECT_EQ(added, 8u);
    EXPECT_EQ(out.size(), 11u);
    EXPECT_EQ(out[2], glm::dvec3(7.0));
}

TEST(ClipBox, EmptyInfiniteAndNanInputsGiveNothing) {
    EXPECT_TRUE(clip(kPyramid, Aabb{}).empty());
    EXPECT_TRUE(clip(kPyramid, {glm::dvec3(-kInfinity), glm::dvec3(kInfinity)}).empty());
    EXPECT_TRUE(clip(kPyramid, {glm::dvec3(kNan), glm::dvec3(1.0)}).empty());
    Frustum broken = kPyramid;
    broken.planes[2].normal.x = kNan;
    EXPECT_TRUE(clip(broken, {glm::dvec3(-9.0), glm::dvec3(9.0)}).empty());
}

struct RandomScene {
    Frustum frustum;
    Aabb box;
};

RandomScene random_scene(std::mt19937_64& random) {
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto vector = [&] { return glm::dvec3(number(random), number(random), number(random)); };
    const auto size = [&] { return std::exp2(4.0 * number(random)); };
    RandomScene s;
    const glm::dmat3 rotation = basis_from_back(vector());
    const double near_m = 0.01 + 0.2 * std::abs(number(random));
    const double far_m = number(random) < -0.5 ? kInfinity : near_m + size();
    s.frustum = number(random) < 0.5
                    ? perspective_frustum(vector(), rotation, 0.3 * size(), 0.3 * size(), near_m, far_m)
                    : orthographic_frustum(vector(), rotation, size(), size(), -near_m, far_m);
    const glm::dvec3 centre = vector();
    glm::dvec3 half(size(), size(), size());
    if (number(random) < -0.5) half[static_cast<int>(random() % 3)] = 0.0;
    if (number(random) < -0.8) half[static_cast<int>(random() % 3)] = 0.0;
    s.box = {centre - half, centre + half};
    return s;
}

double signed_distance(const Plane& plane, const glm::dvec3& p) {
    return (glm::dot(plane.normal, p) + plane.offset) / glm::length(plane.normal);
}

TEST(ClipBox, EveryVertexSatisfiesEveryPlane) {
    std::mt19937_64 random(print_seed());
    for (int round = 0; round < 20000; ++round) {
        const RandomScene s = random_scene(random);
        const double scale = glm::length(half_extent(s.box)) + glm::length(centre(s.box));
        for (const glm::dvec3& p : clip(s.frustum, s.box)) {
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_GE(p[axis], s.box.min[axis]) << "round " << round;
                ASSERT_LE(p[axis], s.box.max[axis]) << "round " << round;
            }
            for (std::uint32_t i = 0; i < s.frustum.plane_count; ++i) {
                ASSERT_GE(signed_distance(s.frustum.planes[i], p), -1e-9 * scale)
                    << "round " << round << " plane " << i;
            }
        }
    }
}

TEST(ClipBox, EveryCommonPointLiesWithinTheVerticesReach) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    int common = 0;
    for (int round = 0; round < 20000; ++round) {
        const RandomScene s = random_scene(random);
        const auto vertices = clip(s.frustum, s.box);
        const double scale = glm::length(half_extent(s.box)) + glm::length(centre(s.box));
        for (int sample = 0; sample < 40; ++sample) {
            const glm::dvec3 p = glm::mix(s.box.min, s.box.max, glm::dvec3(unit(random), unit(random), unit(random)));
            bool in = true;
            for (std::uint32_t i = 0; i < s.frustum.plane_count; ++i) {
                in = in && signed_distance(s.frustum.planes[i], p) >= 0.0;
            }
            if (!in) continue;
            ++common;
            const glm::dvec3 direction(number(random), number(random), number(random));
            double reach = -kInfinity;
            for (const glm::dvec3& v : vertices) reach = std::max(reach, glm::dot(direction, v));
            ASSERT_GE(reach, glm::dot(direction, p) - 1e-12 * scale) << "round " << round;
        }
    }
    EXPECT_GT(common, 10000) << "too few samples fell into both volumes for the test to mean anything";
}

// Brute force: all crossings of three planes that satisfy the others are the vertices, and nothing else is.
TEST(ClipBox, TheReachInEveryDirectionIsThatOfAllThreePlaneCrossings) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    int compared = 0;
    for (int round = 0; round < 3000; ++round) {
        const RandomScene s = random_scene(random);
        const double scale = glm::length(half_extent(s.box)) + glm::length(centre(s.box));
        std::vector<Plane> planes(s.frustum.planes, s.frustum.planes + s.frustum.plane_count);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 n(0.0);
            n[axis] = 1.0;
            planes.push_back({n, -s.box.min[axis]});
            planes.push_back({-n, s.box.max[axis]});
        }
        std::vector<glm::dvec3> want;
        for (std::size_t i = 0; i < planes.size(); ++i) {
            for (std::size_t j = i + 1; j < planes.size(); ++j) {
                for (std::size_t k = j + 1; k < planes.size(); ++k) {
                    const glm::dvec3 a = planes[i].normal, b = planes[j].normal, c = planes[k].normal;
                    const double det = glm::dot(a, glm::cross(b, c));
                    if (std::abs(det) < 1e-6 * glm::length(a) * glm::length(b) * glm::length(c)) continue;
                    const glm::dvec3 p = -(planes[i].offset * glm::cross(b, c) + planes[j].offset * glm::cross(c, a) +
                                           planes[k].offset * glm::cross(a, b)) /
                                         det;
                    bool in = true;
                    for (const Plane& plane : planes) in = in && signed_distance(plane, p) >= -1e-9 * scale;
                    if (in) want.push_back(p);
                }
            }
        }
        const auto got = clip(s.frustum, s.box);
        if (want.empty() || got.empty()) {
            // Both find nothing, except where no more than a sliver within the brute force's tolerance is common.
            Aabb reach;
            for (const glm::dvec3& v : got) reach = extended(reach, v);
            for (const glm::dvec3& v : want) reach = extended(reach, v);
            ASSERT_TRUE(is_empty(reach) || glm::length(half_extent(reach)) < 1e-4 * scale) << "round " << round;
            continue;
        }
        ++compared;
        for (int k = 0; k < 20; ++k) {
            const glm::dvec3 direction(number(random), number(random), number(random));
            double got_reach = -kInfinity, want_reach = -kInfinity;
            for (const glm::dvec3& v : got) got_reach = std::max(got_reach, glm::dot(direction, v));
            for (const glm::dvec3& v : want) want_reach = std::max(want_reach, glm::dot(direction, v));
            ASSERT_NEAR(got_reach, want_reach, 1e-7 * scale) << "round " << round;
        }
    }
    EXPECT_GT(compared, 500);
}

TEST(ClipBox, ScalingByAPowerOfTwoScalesTheResultExactly) {
    std::mt19937_64 random(print_seed());
    for (int round = 0; round < 2000; ++round) {
        const RandomScene s = random_scene(random);
        const auto base = clip(s.frustum, s.box);
        for (const int power : {-80, -13, 27, 80}) {
            const double factor = std::ldexp(1.0, power);
            Frustum f = s.frustum;
            for (Plane& plane : f.planes) plane.offset *= factor;
            const auto scaled = clip(f, {s.box.min * factor, s.box.max * factor});
            ASSERT_EQ(scaled.size(), base.size()) << "round " << round << " power " << power;
            for (std::size_t i = 0; i < base.size(); ++i) ASSERT_EQ(scaled[i], base[i] * factor) << "round " << round;
        }
    }
}

TEST(ClippedBounds, HoldAllThatClippingLeavesAndOftenNoMore) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> number(-10.0, 10.0);
    const auto vector = [&] { return glm::dvec3(number(random), number(random), number(random)); };
    double shares = 0.0;
    int clipped = 0;
    for (int round = 0; round < 2000; ++round) {
        const glm::dmat3 turn = basis_from_back(vector());
        const double far_m = round % 2 == 0 ? kInfinity : 12.0;
        const Frustum f = round % 3 == 0 ? orthographic_frustum(vector(), turn, 3.0, 2.0, 0.1, far_m)
                                         : perspective_frustum(vector(), turn, 0.5, 0.3, 0.1, far_m);
        const glm::dvec3 a = vector(), b = vector();
        const Aabb box{glm::min(a, b), glm::max(a, b)};
        const Aabb bounds = clipped_bounds(planes_of(f), box);
        Aabb exact;
        for (const glm::dvec3& p : clip(f, box)) exact = extended(exact, p);
        if (is_empty(exact)) continue;
        ++clipped;
        EXPECT_TRUE(glm::all(glm::lessThanEqual(bounds.min, exact.min + 1e-12)) &&
                    glm::all(glm::greaterThanEqual(bounds.max, exact.max - 1e-12)))
            << round;
        shares += glm::length(half_extent(exact)) / glm::length(half_extent(bounds));
    }
    EXPECT_GT(clipped, 100);
    EXPECT_GT(shares / clipped, 0.7);
    const Aabb slab = clipped_bounds(planes_of(kSlab), {glm::dvec3(-9.0), glm::dvec3(9.0)});
    EXPECT_LT(glm::distance(slab.min, {-2, -2, -5}) + glm::distance(slab.max, {2, 2, -1}), 1e-12);
    EXPECT_TRUE(is_empty(clipped_bounds(planes_of(kSlab), {glm::dvec3(3.0), glm::dvec3(9.0)})));
    const std::array<Plane, 1> broken = {Plane{glm::dvec3(kNan), 1.0}};
    EXPECT_EQ(clipped_bounds(broken, {glm::dvec3(-1.0), glm::dvec3(1.0)}), (Aabb{glm::dvec3(-1.0), glm::dvec3(1.0)}));
}

TEST(ClipBox, FarFromTheOriginTheShapeStaysWithinTheRoundingOfItsPosition) {
    const glm::dvec3 far_away(1e8, -1e8, 1e8);
    const Frustum f = perspective_frustum(far_away, glm::dmat3(1.0), 1.0, 1.0, 1.0, 4.0);
    std::vector<glm::dvec3> want = kPyramidCorners;
    for (glm::dvec3& p : want) p += far_away;
    expect_same_points(clip(f, {far_away - 100.0, far_away + 100.0}), want, 1e-6);
}

}  // namespace
}  // namespace gnomon::math
