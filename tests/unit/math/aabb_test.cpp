#include "engine/math/aabb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/unit/math/random_seed.h"

namespace gnomon::math {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const Aabb kUnit{glm::dvec3(0.0), glm::dvec3(1.0)};

TEST(Aabb, ADefaultBoxIsEmptyAndAPointIsNot) {
    EXPECT_TRUE(is_empty(Aabb{}));
    EXPECT_FALSE(is_empty(Aabb{glm::dvec3(2.0), glm::dvec3(2.0)}));
}

TEST(Aabb, ABoxWithANanIsEmptyAndNotFinite) {
    for (int axis = 0; axis < 3; ++axis) {
        Aabb low = kUnit;
        low.min[axis] = kNan;
        Aabb high = kUnit;
        high.max[axis] = kNan;
        EXPECT_TRUE(is_empty(low) && is_empty(high)) << axis;
        EXPECT_FALSE(is_finite(low) || is_finite(high)) << axis;
    }
    EXPECT_TRUE(is_finite(kUnit));
    EXPECT_FALSE(is_finite({glm::dvec3(0.0), glm::dvec3(1.0, kInfinity, 1.0)}));
}

TEST(Aabb, MergingWithAnEmptyOrNanBoxChangesNothing) {
    EXPECT_EQ(merged(kUnit, Aabb{}), kUnit);
    EXPECT_EQ(merged(Aabb{}, kUnit), kUnit);
    const Aabb broken{glm::dvec3(kNan, -9.0, -9.0), glm::dvec3(9.0)};
    EXPECT_EQ(merged(kUnit, broken), kUnit);
    EXPECT_EQ(merged(broken, kUnit), kUnit);
    EXPECT_EQ(merged(broken, broken), Aabb{});
}

TEST(Aabb, MergingCoversBothBoxes) {
    const Aabb other{glm::dvec3(-1.0, 0.5, 3.0), glm::dvec3(0.5, 4.0, 5.0)};
    EXPECT_EQ(merged(kUnit, other), (Aabb{glm::dvec3(-1.0, 0.0, 0.0), glm::dvec3(1.0, 4.0, 5.0)}));
}

TEST(Aabb, ExtendingAnEmptyBoxGivesThePointAndANanPointIsIgnored) {
    const glm::dvec3 p(3.0, -2.0, 1.0);
    EXPECT_EQ(extended(Aabb{}, p), (Aabb{p, p}));
    EXPECT_EQ(extended(kUnit, p), (Aabb{glm::dvec3(0.0, -2.0, 0.0), glm::dvec3(3.0, 1.0, 1.0)}));
    EXPECT_EQ(extended(kUnit, {5.0, kNan, 5.0}), kUnit);
}

TEST(Aabb, TouchingBoxesOverlapAndSeparatedOnesDoNot) {
    for (int axis = 0; axis < 3; ++axis) {
        Aabb next = kUnit;
        next.min[axis] = 1.0;
        next.max[axis] = 2.0;
        EXPECT_TRUE(overlaps(kUnit, next)) << axis;
        EXPECT_TRUE(overlaps(next, kUnit)) << axis;
        next.min[axis] = std::nextafter(1.0, 2.0);
        EXPECT_FALSE(overlaps(kUnit, next)) << axis;
        EXPECT_FALSE(overlaps(next, kUnit)) << axis;
    }
}

TEST(Aabb, AnEmptyBoxOverlapsNothing) {
    EXPECT_FALSE(overlaps(Aabb{}, kUnit));
    EXPECT_FALSE(overlaps(kUnit, Aabb{}));
    const Aabb inverted_in_one_axis{glm::dvec3(-1.0, 0.7, -1.0), glm::dvec3(2.0, 0.2, 2.0)};
    EXPECT_FALSE(overlaps(kUnit, inverted_in_one_axis));
    EXPECT_FALSE(overlaps(kUnit, {glm::dvec3(kNan), glm::dvec3(kNan)}));
}

TEST(Aabb, CornersFollowTheirBits) {
    const auto c = corners({glm::dvec3(1.0, 2.0, 3.0), glm::dvec3(4.0, 5.0, 6.0)});
    EXPECT_EQ(c[0], glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(c[1], glm::dvec3(4.0, 2.0, 3.0));
    EXPECT_EQ(c[2], glm::dvec3(1.0, 5.0, 3.0));
    EXPECT_EQ(c[4], glm::dvec3(1.0, 2.0, 6.0));
    EXPECT_EQ(c[7], glm::dvec3(4.0, 5.0, 6.0));
}

TEST(Aabb, TheTransformedBoxIsThatOfTheTransformedCorners) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> number(-10.0, 10.0);
    const auto vector = [&] { return glm::dvec3(number(random), number(random), number(random)); };
    for (int round = 0; round < 2000; ++round) {
        const Aabb box = extended(extended(Aabb{}, vector()), vector());
        const glm::dmat3 basis(vector(), vector(), vector());
        const glm::dvec3 translation = vector();
        const Aabb got = transformed(box, basis, translation);
        Aabb want;
        for (const glm::dvec3& c : corners(box)) want = extended(want, basis * c + translation);
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_NEAR(got.min[axis], want.min[axis], 1e-12) << "round " << round;
            ASSERT_NEAR(got.max[axis], want.max[axis], 1e-12) << "round " << round;
        }
    }
}

TEST(Aabb, TransformingKeepsEmptyEmptyAndNanBecomesEmpty) {
    EXPECT_EQ(transformed(Aabb{}, glm::dmat3(1.0), glm::dvec3(5.0)), Aabb{});
    glm::dmat3 broken(1.0);
    broken[1][2] = kNan;
    EXPECT_TRUE(is_empty(transformed(kUnit, broken, glm::dvec3(0.0))));
    EXPECT_TRUE(is_empty(transformed(kUnit, glm::dmat3(1.0), glm::dvec3(0.0, kNan, 0.0))));
}

TEST(Aabb, TransformingAnInfiniteBoxWithZerosInTheBasisMakesNoNan) {
    const Aabb all{glm::dvec3(-kInfinity), glm::dvec3(kInfinity)};
    EXPECT_EQ(transformed(all, glm::dmat3(1.0), glm::dvec3(3.0)), all);
}

TEST(Aabb, DistancesAreToTheNearestPointAndTheFarthestCorner) {
    EXPECT_EQ(distance(kUnit, {0.5, 0.5, 0.5}), 0.0);
    EXPECT_EQ(distance(kUnit, {0.5, 3.0, 0.5}), 2.0);
    EXPECT_EQ(distance(kUnit, {-3.0, 5.0, 1.0}), 5.0);
    EXPECT_DOUBLE_EQ(farthest_distance(kUnit, {0.0, 0.0, 0.0}), std::sqrt(3.0));
    EXPECT_DOUBLE_EQ(farthest_distance(kUnit, {0.5, 0.5, -2.0}), std::sqrt(9.5));
}

TEST(Aabb, DistancesOfEmptyBoxesAndNanPointsAreAsDocumented) {
    EXPECT_EQ(distance(Aabb{}, glm::dvec3(0.0)), kInfinity);
    EXPECT_EQ(farthest_distance(Aabb{}, glm::dvec3(0.0)), 0.0);
    EXPECT_TRUE(std::isnan(distance(kUnit, {0.0, kNan, 0.0})));
    EXPECT_TRUE(std::isnan(farthest_distance(kUnit, {0.0, 0.0, kNan})));
}

}  // namespace
}  // namespace gnomon::math
