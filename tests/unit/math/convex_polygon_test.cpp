#include "engine/math/convex_polygon.h"

#include <gmock/gmock.h>

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

}  // namespace
}  // namespace gnomon::math
