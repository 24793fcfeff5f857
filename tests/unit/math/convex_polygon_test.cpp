#include "engine/math/convex_polygon.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/unit/math/random_seed.h"

namespace gnomon::math {
namespace {

using Points = std::vector<glm::dvec2>;

Points hull_of(Points points) {
    Points hull;
    convex_hull(points, hull);
    return hull;
}

long double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const long double ux = static_cast<long double>(b.x) - a.x, uy = static_cast<long double>(b.y) - a.y;
    return ux * (static_cast<long double>(c.y) - a.y) - uy * (static_cast<long double>(c.x) - a.x);
}

TEST(ConvexHull, HoldsEveryPointAndTurnsLeftEverywhere) {
    std::mt19937_64 random(print_seed());
    std::normal_distribution<double> number(0.0, 3.0);
    for (const std::size_t count : {3u, 10u, 63u, 64u, 2000u}) {
        for (int round = 0; round < 20; ++round) {
            Points points;
            for (std::size_t i = 0; i < count; ++i) points.emplace_back(number(random), number(random));
            const Points hull = hull_of(points);
            ASSERT_GE(hull.size(), 3u);
            for (std::size_t i = 0; i < hull.size(); ++i) {
                const glm::dvec2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
                EXPECT_GT(turn(a, b, hull[(i + 2) % hull.size()]), 0.0L);
                for (const glm::dvec2& p : points) ASSERT_GE(turn(a, b, p), -1e-13L);
            }
        }
    }
}

TEST(ConvexHull, ManyPointsOfASquareAreFourCorners) {
    Points points;
    for (int i = 0; i <= 20; ++i)
        for (int k = 0; k <= 20; ++k) points.emplace_back(i, k);
    EXPECT_THAT(hull_of(points), ::testing::ElementsAre(glm::dvec2(0, 0), glm::dvec2(20, 0), glm::dvec2(20, 20), glm::dvec2(0, 20)));
}

TEST(ConvexHull, OfNothingAPointOrALineIsThat) {
    EXPECT_TRUE(hull_of({}).empty());
    for (const std::size_t count : {1u, 2u, 70u}) {
        for (const glm::dvec2& p : hull_of(Points(count, glm::dvec2(2, 3)))) EXPECT_EQ(p, glm::dvec2(2, 3));
        EXPECT_FALSE(hull_of(Points(count, glm::dvec2(2, 3))).empty());
    }
    Points line;
    for (int i = 0; i < 100; ++i) line.emplace_back(i % 10, 2 * (i % 10));
    EXPECT_THAT(hull_of(line), ::testing::UnorderedElementsAre(glm::dvec2(0, 0), glm::dvec2(9, 18)));
}

TEST(ConvexHull, APowerOfTwoScalesItExactly) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    Points points;
    for (int i = 0; i < 500; ++i) points.emplace_back(number(random), number(random));
    Points scaled = points;
    for (glm::dvec2& p : scaled) p *= 0x1p-30;
    Points hull = hull_of(points);
    for (glm::dvec2& p : hull) p *= 0x1p-30;
    EXPECT_EQ(hull_of(scaled), hull);
}

TEST(ClipPolygon, KeepsTheSideAskedFor) {
    Points square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, scratch;
    clip_polygon({1, 0}, -1.0, square, scratch);
    EXPECT_THAT(square, ::testing::UnorderedElementsAre(glm::dvec2(1, 0), glm::dvec2(4, 0), glm::dvec2(4, 4), glm::dvec2(1, 4)));
    clip_polygon({-1, -1}, 3.0, square, scratch);
    EXPECT_THAT(square, ::testing::UnorderedElementsAre(glm::dvec2(1, 0), glm::dvec2(3, 0), glm::dvec2(1, 2)));
    clip_polygon({0, 1}, -3.0, square, scratch);
    EXPECT_TRUE(square.empty());
    clip_polygon({0, 1}, -3.0, square, scratch);
    EXPECT_TRUE(square.empty());
}

TEST(ClipPolygon, KeepsAPointAndALineThatAreInside) {
    Points point = {{2, 2}}, line = {{0, 0}, {4, 0}}, scratch;
    clip_polygon({1, 0}, -1.0, point, scratch);
    EXPECT_THAT(point, ::testing::ElementsAre(glm::dvec2(2, 2)));
    clip_polygon({1, 0}, -1.0, line, scratch);
    EXPECT_THAT(line, ::testing::Contains(glm::dvec2(1, 0)));
    EXPECT_THAT(line, ::testing::Contains(glm::dvec2(4, 0)));
    EXPECT_THAT(line, ::testing::Not(::testing::Contains(glm::dvec2(0, 0))));
}

TEST(DropFlatCorners, LeavesOutWhatRoundingSplitsOrAddsAlongASide) {
    constexpr double kTolerance = 1e-9;
    const Points square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    // A corner twice, a corner along a side, and both at once.
    for (Points polygon : {Points{{0, 0}, {4, 0}, {4, 1e-12}, {4, 4}, {0, 4}}, Points{{0, 0}, {2, -1e-12}, {4, 0}, {4, 4}, {0, 4}},
                           Points{{0, 4}, {-1e-12, 1}, {0, 0}, {1e-13, -1e-13}, {1, -1e-12}, {3, -1e-12}, {4, 0}, {4, 4}}}) {
        Points scratch;
        drop_flat_corners(kTolerance, polygon, scratch);
        ASSERT_EQ(polygon.size(), 4u);
        for (const glm::dvec2& p : polygon)
            EXPECT_LT(std::min({glm::distance(p, square[0]), glm::distance(p, square[1]), glm::distance(p, square[2]),
                                glm::distance(p, square[3])}), kTolerance);
    }
}

TEST(DropFlatCorners, LosesNoMoreThanTheToleranceEvenOfARoundPolygon) {
    for (const double tolerance : {0.0, 1e-3, 0.1}) {
        Points circle, scratch;
        for (int i = 0; i < 200; ++i) circle.emplace_back(std::cos(0.0314159265 * i), std::sin(0.0314159265 * i));
        Points polygon = circle;
        drop_flat_corners(tolerance, polygon, scratch);
        if (tolerance == 0.0) {
            EXPECT_EQ(polygon.size(), circle.size());
        } else {
            EXPECT_LT(polygon.size(), circle.size() / 2);
        }
        for (const glm::dvec2& p : circle)
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                EXPECT_GE(turn(a, b, p) / static_cast<long double>(glm::distance(a, b)), -tolerance - 1e-12L);
            }
    }
}

TEST(DropFlatCorners, OfAPointOrALineThatIsLeft) {
    for (const Points& given : {Points{}, Points{{1, 2}}, Points{{1, 2}, {3, 4}}}) {
        Points polygon = given, scratch;
        drop_flat_corners(1e-9, polygon, scratch);
        EXPECT_THAT(polygon, ::testing::UnorderedElementsAreArray(given));
    }
    Points speck = {{0, 0}, {1e-12, 0}, {0, 1e-12}}, scratch;
    drop_flat_corners(1e-9, speck, scratch);
    EXPECT_EQ(speck.size(), 1u);
}

}  // namespace
}  // namespace gnomon::math
