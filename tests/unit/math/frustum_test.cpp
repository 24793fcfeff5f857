#include "engine/math/frustum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "tests/unit/math/random_seed.h"
#include "tests/unit/not_finite.h"

namespace gnomon::math {
namespace {

bool inside(const Frustum& f, const glm::dvec3& p) {
    for (std::uint32_t i = 0; i < f.plane_count; ++i) {
        if (glm::dot(f.planes[i].normal, p) + f.planes[i].offset < 0.0) return false;
    }
    return true;
}

Aabb cube_at(const glm::dvec3& centre, double half) { return {centre - half, centre + half}; }

void expect_rotation(const glm::dmat3& m, const glm::dvec3& back) {
    const glm::dmat3 square = glm::transpose(m) * m;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) ASSERT_NEAR(square[i][j], i == j ? 1.0 : 0.0, 4e-15);
    }
    ASSERT_NEAR(glm::determinant(m), 1.0, 4e-15);
    ASSERT_NEAR(glm::dot(m[2], back) / glm::length(back), 1.0, 4e-15);
}

TEST(BasisFromBack, IsARightHandedRotationForEveryDirection) {
    std::mt19937_64 random(print_seed());
    std::normal_distribution<double> number;
    for (int round = 0; round < 10000; ++round) {
        const glm::dvec3 back(number(random), number(random), number(random));
        expect_rotation(basis_from_back(back), back);
    }
}

TEST(BasisFromBack, HoldsAtThePolesAndBesideThem) {
    for (const double z : {1.0, -1.0}) {
        for (const double tilt : {0.0, 1e-300, 1e-16, 1e-9, -1e-9}) {
            expect_rotation(basis_from_back({tilt, -tilt, z}), {tilt, -tilt, z});
        }
    }
    expect_rotation(basis_from_back({1.0, 0.0, 0.0}), {1.0, 0.0, 0.0});
    expect_rotation(basis_from_back({0.0, -1.0, -0.0}), {0.0, -1.0, 0.0});
    EXPECT_EQ(basis_from_back({0.0, 0.0, 2.0}), glm::dmat3(1.0));
}

TEST(BasisFromBack, TheLengthOfTheDirectionDoesNotMatter) {
    const glm::dvec3 back(0.3, -0.8, 0.2);
    EXPECT_EQ(basis_from_back(back * 0x1p-600), basis_from_back(back));
    EXPECT_EQ(basis_from_back(back * 0x1p+600), basis_from_back(back));
}

TEST(Frustum, PerspectiveHoldsWhatItsCameraSees) {
    const glm::dvec3 eye(10.0, 2.0, -4.0);
    const glm::dmat3 rotation = basis_from_back({-1.0, 0.4, 0.7});
    const Frustum f = perspective_frustum(eye, rotation, 0.5, 0.25, 1.0, 100.0);
    ASSERT_EQ(f.plane_count, 6u);
    const auto at = [&](double x, double y, double depth) { return eye + rotation * glm::dvec3(x, y, -depth); };
    EXPECT_TRUE(inside(f, at(0.0, 0.0, 50.0)));
    EXPECT_TRUE(inside(f, at(24.9, 12.4, 50.0)));
    EXPECT_FALSE(inside(f, at(25.1, 0.0, 50.0)));
    EXPECT_FALSE(inside(f, at(-25.1, 0.0, 50.0)));
    EXPECT_FALSE(inside(f, at(0.0, 12.6, 50.0)));
    EXPECT_FALSE(inside(f, at(0.0, -12.6, 50.0)));
    EXPECT_FALSE(inside(f, at(0.0, 0.0, 0.9)));
    EXPECT_FALSE(inside(f, at(0.0, 0.0, 100.1)));
    EXPECT_FALSE(inside(f, at(0.0, 0.0, -50.0)));
}

TEST(Frustum, AnInfiniteFarPlaneIsLeftOut) {
    const Frustum f = perspective_frustum(glm::dvec3(0.0), glm::dmat3(1.0), 1.0, 1.0, 0.1, kInfinity);
    EXPECT_EQ(f.plane_count, 5u);
    EXPECT_TRUE(inside(f, {0.0, 0.0, -1e30}));
    EXPECT_FALSE(inside(f, {0.0, 0.0, 1e30}));
}

TEST(Frustum, OrthographicIsABoxAndItsNearPlaneMayLieBehind) {
    const Frustum f = orthographic_frustum({1.0, 2.0, 3.0}, glm::dmat3(1.0), 4.0, 2.0, -1.0, 10.0);
    ASSERT_EQ(f.plane_count, 6u);
    EXPECT_TRUE(inside(f, {4.9, 3.9, 3.9}));
    EXPECT_TRUE(inside(f, {-2.9, 0.1, -6.9}));
    EXPECT_FALSE(inside(f, {5.1, 2.0, 0.0}));
    EXPECT_FALSE(inside(f, {1.0, -0.1, 0.0}));
    EXPECT_FALSE(inside(f, {1.0, 2.0, 4.1}));
    EXPECT_FALSE(inside(f, {1.0, 2.0, -7.1}));
}

TEST(Frustum, MayOverlapRejectsBoxesBeyondAnyPlaneAndKeepsTouchingOnes) {
    const Frustum f = orthographic_frustum(glm::dvec3(0.0), glm::dmat3(1.0), 1.0, 1.0, 0.0, 10.0);
    EXPECT_TRUE(may_overlap(f, cube_at({0.0, 0.0, -5.0}, 0.5)));
    EXPECT_TRUE(may_overlap(f, cube_at({0.0, 0.0, -5.0}, 500.0)));
    EXPECT_TRUE(may_overlap(f, cube_at({2.0, 0.0, -5.0}, 1.0)));
    EXPECT_FALSE(may_overlap(f, cube_at({2.1, 0.0, -5.0}, 1.0)));
    EXPECT_FALSE(may_overlap(f, cube_at({-2.1, 0.0, -5.0}, 1.0)));
    EXPECT_FALSE(may_overlap(f, cube_at({0.0, 2.1, -5.0}, 1.0)));
    EXPECT_FALSE(may_overlap(f, cube_at({0.0, -2.1, -5.0}, 1.0)));
    EXPECT_FALSE(may_overlap(f, cube_at({0.0, 0.0, 1.1}, 1.0)));
    EXPECT_FALSE(may_overlap(f, cube_at({0.0, 0.0, -11.1}, 1.0)));
}

TEST(Frustum, MayOverlapRejectsEmptyBoxesAndKeepsWhatItCannotJudge) {
    Frustum f = orthographic_frustum(glm::dvec3(0.0), glm::dmat3(1.0), 1.0, 1.0, 0.0, 10.0);
    EXPECT_FALSE(may_overlap(f, Aabb{}));
    EXPECT_FALSE(may_overlap(f, {glm::dvec3(kNan), glm::dvec3(1.0)}));
    EXPECT_TRUE(may_overlap(f, {glm::dvec3(-kInfinity), glm::dvec3(kInfinity)}));
    f.planes[0].offset = kNan;
    EXPECT_TRUE(may_overlap(f, cube_at({0.0, 0.0, -5.0}, 0.5)));
}

TEST(Frustum, MayOverlapNeverRejectsABoxHoldingAnInsidePoint) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto vector = [&] { return glm::dvec3(number(random), number(random), number(random)); };
    for (int round = 0; round < 20000; ++round) {
        const double scale = std::ldexp(1.0, static_cast<int>(number(random) * 60.0));
        const Frustum f =
            perspective_frustum(vector() * scale, basis_from_back(vector()), 0.1 + std::abs(number(random)),
                                0.1 + std::abs(number(random)), 0.01 * scale, 2.0 * scale);
        const glm::dvec3 p = vector() * scale;
        if (!inside(f, p)) continue;
        ASSERT_TRUE(may_overlap(f, {p, p})) << "round " << round;
        ASSERT_TRUE(may_overlap(f, cube_at(p, 0.1 * scale))) << "round " << round;
    }
}

}  // namespace
}  // namespace gnomon::math
