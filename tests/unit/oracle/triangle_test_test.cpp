#include "tests/oracle/triangle_test.h"

#include <gtest/gtest.h>

#include <random>

namespace gnomon::oracle {
namespace {

const glm::dvec3 kA{0.0, 0.0, 0.0}, kB{1.0, 0.0, 0.0}, kC{0.0, 1.0, 0.0};

TEST(TriangleTest, HitsTheInsideFromBothSidesAndTellsWhere) {
    ExactHit hit;
    ASSERT_TRUE(intersect(make_ray({0.25, 0.5, 3.0}, {0.0, 0.0, -2.0}), kA, kB, kC, hit));
    EXPECT_DOUBLE_EQ(hit.t, 1.5);
    EXPECT_DOUBLE_EQ(hit.u, 0.25);
    EXPECT_DOUBLE_EQ(hit.v, 0.25);
    EXPECT_DOUBLE_EQ(hit.w, 0.5);
    ASSERT_TRUE(intersect(make_ray({0.25, 0.5, -3.0}, {0.0, 0.0, 2.0}), kA, kB, kC, hit));
    EXPECT_DOUBLE_EQ(hit.t, 1.5);
}

TEST(TriangleTest, ReportsWhatLiesBehindTheOriginWithNegativeT) {
    ExactHit hit;
    ASSERT_TRUE(intersect(make_ray({0.25, 0.25, 3.0}, {0.0, 0.0, 1.0}), kA, kB, kC, hit));
    EXPECT_DOUBLE_EQ(hit.t, -3.0);
}

TEST(TriangleTest, MissesTheOutsideAndTheEdgeOnView) {
    ExactHit hit;
    EXPECT_FALSE(intersect(make_ray({0.6, 0.6, 3.0}, {0.0, 0.0, -1.0}), kA, kB, kC, hit));
    EXPECT_FALSE(intersect(make_ray({-1.0, 0.25, 0.0}, {1.0, 0.0, 0.0}), kA, kB, kC, hit));
    EXPECT_FALSE(intersect(make_ray({0.25, 0.25, 1.0}, {0.0, 0.0, -1.0}), kA, kA, kC, hit));
}

TEST(TriangleTest, AFanWithoutGapsIsHitByEveryRayThroughItsSharedEdges) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0), along(0.0, 1.0);
    const glm::dvec3 corners[] = {{1, 0, 0.1}, {0, 1, -0.3}, {-1, 0, 0.2}, {0, -1, 0.0}};
    int missed = 0;
    for (int i = 0; i < 100'000; ++i) {
        const glm::dvec3 hub(0.1 * any(random), 0.1 * any(random), any(random));
        const glm::dvec3 target = glm::mix(hub, corners[i % 4], 0.9 * along(random));
        const glm::dvec3 origin(any(random), any(random), 4.0);
        const ExactRay ray = make_ray(origin, target - origin);
        ExactHit hit;
        bool any_hit = false;
        for (int k = 0; k < 4; ++k) any_hit = any_hit || intersect(ray, hub, corners[k], corners[(k + 1) % 4], hit);
        missed += any_hit ? 0 : 1;
    }
    EXPECT_EQ(missed, 0);
}

}  // namespace
}  // namespace gnomon::oracle
