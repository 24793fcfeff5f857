#include "engine/math/cone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/unit/math/random_seed.h"

namespace gnomon::math {
namespace {

class ConeTest : public ::testing::Test {
protected:
    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }
    glm::dvec3 vector(double reach) { return {number(-reach, reach), number(-reach, reach), number(-reach, reach)}; }
    Aabb box() {
        const glm::dvec3 centre = vector(10.0), half = glm::abs(vector(3.0));
        return {centre - half, centre + half};
    }
    glm::dvec3 point(const Aabb& b) { return {number(b.min.x, b.max.x), number(b.min.y, b.max.y), number(b.min.z, b.max.z)}; }
    std::mt19937_64 random{print_seed()};
};

bool contains(const Cone& cone, const glm::dvec3& p) {
    const glm::dvec3 to = p - cone.apex;
    return glm::dot(to, cone.axis) > glm::length(to) * std::cos(cone.half_angle_rad);
}

TEST_F(ConeTest, ABoxWithAPointInTheConeIsNeverOutsideNorIsOneOfWhichAPartIsNot) {
    int outside = 0;
    for (int round = 0; round < 20000; ++round) {
        const Cone cone{vector(5.0), glm::normalize(vector(1.0)), number(0.01, 1.5707)};
        const Aabb b = box();
        const auto planes = planes_around(cone);
        if (overlap(planes, b) != Overlap::outside) continue;
        ++outside;
        for (int k = 0; k < 20; ++k) {
            const glm::dvec3 p = point(b), q = point(b);
            EXPECT_FALSE(contains(cone, p));
            EXPECT_EQ(overlap(planes, {glm::min(p, q), glm::max(p, q)}), Overlap::outside);
        }
    }
    EXPECT_GT(outside, 3000);
}

TEST_F(ConeTest, FewBoxesOutsideAreTakenForTouching) {
    int touching = 0, needless = 0;
    for (int round = 0; round < 3000; ++round) {
        const Cone cone{vector(5.0), glm::normalize(vector(1.0)), number(0.05, 1.5)};
        const Aabb b = box();
        if (overlap(planes_around(cone), b) == Overlap::outside) continue;
        ++touching;
        bool any = false;
        for (int k = 0; k < 2000 && !any; ++k) any = contains(cone, point(b));
        needless += any ? 0 : 1;
    }
    EXPECT_LT(needless, touching / 10) << "of " << touching;
    RecordProperty("needless", needless);
}

TEST_F(ConeTest, EdgesLieOnTheirPlanesAndHoldTheCone) {
    for (int round = 0; round < 1000; ++round) {
        const Cone cone{glm::dvec3(0.0), glm::normalize(vector(1.0)), number(0.01, 1.4)};
        const auto planes = planes_around(cone);
        const auto edges = edges_around(cone);
        for (std::size_t i = 0; i < kConeSides; ++i) {
            const double length = glm::length(edges[i]);
            EXPECT_NEAR(glm::dot(planes[i].normal, edges[i]), 0.0, 1e-12 * length);
            EXPECT_NEAR(glm::dot(planes[(i + 1) % kConeSides].normal, edges[i]), 0.0, 1e-12 * length);
            EXPECT_FALSE(contains(cone, edges[i]));
            for (const Plane& plane : planes) EXPECT_GT(glm::dot(plane.normal, edges[i]), -1e-12 * length);
        }
    }
}

TEST_F(ConeTest, ABallIsToldFromABoxToo) {
    for (int round = 0; round < 5000; ++round) {
        const glm::dvec3 centre = vector(5.0);
        const double radius = number(0.1, 12.0);
        const Aabb b = box();
        const Overlap o = overlap_ball(centre, radius, b);
        for (int k = 0; k < 20; ++k) {
            const bool in = glm::distance(point(b), centre) <= radius;
            EXPECT_FALSE(in && o == Overlap::outside);
            EXPECT_FALSE(!in && o == Overlap::inside);
        }
    }
}

TEST_F(ConeTest, AnEmptyBoxIsOutside) {
    EXPECT_EQ(overlap(planes_around({{}, {0, 0, -1}, 1.0}), Aabb{}), Overlap::outside);
    EXPECT_EQ(overlap_ball({}, 1.0, Aabb{}), Overlap::outside);
}

}  // namespace
}  // namespace gnomon::math
