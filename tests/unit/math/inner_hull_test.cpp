#include "engine/math/inner_hull.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "tests/unit/math/random_seed.h"
#include "tests/unit/not_finite.h"

namespace gnomon::math {
namespace {

class RandomPoints {
public:
    explicit RandomPoints(std::uint64_t seed) : random_(seed) {}
    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
    glm::dvec3 vector(double reach) { return {number(-reach, reach), number(-reach, reach), number(-reach, reach)}; }

private:
    std::mt19937_64 random_;
};

InnerHull inner_hull(const std::vector<glm::dvec3>& points) {
    InnerHull hull;
    hull.build(points);
    return hull;
}

std::vector<glm::dvec3> corners_of(const Aabb& box) {
    const auto found = corners(box);
    return {found.begin(), found.end()};
}

/// Returns how far a box reaches beyond all points, along any of many directions: above 0 it is not in their hull.
double beyond(const Aabb& box, const std::vector<glm::dvec3>& points, RandomPoints& random) {
    constexpr int kDirections = 2000;
    double most = -kInfinity;
    for (int i = 0; i < kDirections; ++i) {
        const glm::dvec3 d = glm::normalize(random.vector(1.0) + glm::dvec3(1e-9));
        double reach = -kInfinity;
        for (const glm::dvec3& p : points) reach = std::max(reach, glm::dot(d, p));
        for (const glm::dvec3& c : corners(box)) most = std::max(most, glm::dot(d, c) - reach);
    }
    return most;
}

TEST(InnerHull, ABoxContainsItselfAndNothingLarger) {
    const Aabb box{{-1.0, 2.0, 3.0}, {4.0, 5.0, 9.0}};
    const InnerHull hull = inner_hull(corners_of(box));
    EXPECT_EQ(hull.normals().size(), 12u);
    EXPECT_TRUE(hull.contains(box));
    EXPECT_TRUE(hull.contains({{0.0, 3.0, 4.0}, {1.0, 4.0, 5.0}}));
    for (int axis = 0; axis < 3; ++axis) {
        Aabb larger = box;
        larger.max[axis] += 1e-9;
        EXPECT_FALSE(hull.contains(larger)) << axis;
    }
    EXPECT_FALSE(hull.contains({}));
    EXPECT_FALSE(hull.contains({glm::dvec3(kNan), glm::dvec3(1.0)}));
}

TEST(InnerHull, CornersOfATetrahedronsBoxAreOutside) {
    const InnerHull hull = inner_hull({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}});
    EXPECT_TRUE(hull.contains({glm::dvec3(0.05), glm::dvec3(0.3)}));
    EXPECT_FALSE(hull.contains({glm::dvec3(0.05), glm::dvec3(0.4)})) << "its corner is beyond the slanting facet";
}

TEST(InnerHull, ContainsWhatLiesInTheHullOfRandomPoints) {
    RandomPoints random(print_seed());
    std::size_t contained = 0, tried = 0;
    for (int round = 0; round < 60; ++round) {
        const double scale = std::exp2(random.number(-20.0, 20.0));
        const glm::dvec3 offset = round % 3 == 0 ? random.vector(1000.0 * scale) : glm::dvec3(0.0);
        std::vector<glm::dvec3> points;
        const int count = 4 + round;
        for (int i = 0; i < count; ++i) points.push_back(offset + random.vector(scale));
        const InnerHull hull = inner_hull(points);
        std::size_t last_facet = static_cast<std::size_t>(round);  // may name no facet
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 middle = offset + random.vector(0.6 * scale), half = glm::abs(random.vector(0.1 * scale));
            const Aabb box{middle - half, middle + half};
            ++tried;
            EXPECT_EQ(hull.contains(box, last_facet), hull.contains(box)) << "facet " << last_facet;
            if (!hull.contains(box)) continue;
            ++contained;
            EXPECT_LE(beyond(box, points, random), 1e-9 * scale) << "round " << round;
        }
    }
    EXPECT_GT(contained, tried / 4);
}

TEST(InnerHull, PointsOfAPlaneOrFewOrNotFiniteContainNothing) {
    const Aabb point{glm::dvec3(0.25, 0.25, 0.0), glm::dvec3(0.25, 0.25, 0.0)};
    EXPECT_FALSE(inner_hull({}).contains(point));
    EXPECT_FALSE(inner_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).contains(point));
    EXPECT_FALSE(inner_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 1e-14}}).contains(point));
    EXPECT_FALSE(inner_hull({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).contains({glm::dvec3(0.0), glm::dvec3(0.0)}));
    EXPECT_FALSE(inner_hull({{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, kNan}, {0, 0, 1}}).contains(point));
}

TEST(InnerHull, GridsOfPointsAreAsLargeAsTheirBox) {
    std::vector<glm::dvec3> points;
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y)
            for (int z = 0; z < 4; ++z) points.emplace_back(x, y, z);
    const InnerHull hull = inner_hull(points);
    EXPECT_TRUE(hull.contains({glm::dvec3(0.0), glm::dvec3(3.0)}));
    EXPECT_FALSE(hull.contains({glm::dvec3(0.0), glm::dvec3(3.0, 3.0, 3.1)}));
}

}  // namespace
}  // namespace gnomon::math
