#include "engine/math/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec4.hpp>
#include <limits>
#include <random>

#include "tests/unit/math/random_seed.h"
#include "tests/unit/not_finite.h"

namespace gnomon::math {
namespace {

glm::dvec3 project(const glm::dmat4& m, const glm::dvec3& p) {
    const glm::dvec4 clip = m * glm::dvec4(p, 1.0);
    return glm::dvec3(clip) / clip.w;
}

void expect_near(const glm::dvec3& got, const glm::dvec3& want, double tolerance = 1e-14) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(got[axis], want[axis], tolerance) << "axis " << axis;
}

TEST(Projection, OrthographicMapsItsCornersToTheClipBoxWithNearAtOne) {
    const glm::dmat4 m = reversed_orthographic(-2.0, 6.0, 1.0, 3.0, -5.0, 20.0);
    expect_near(project(m, {-2.0, 1.0, 5.0}), {-1.0, -1.0, 1.0});
    expect_near(project(m, {6.0, 3.0, -20.0}), {1.0, 1.0, 0.0});
    expect_near(project(m, {2.0, 2.0, -7.5}), {0.0, 0.0, 0.5});
}

TEST(Projection, PerspectiveMapsItsCornersToTheClipBoxWithNearAtOne) {
    const glm::dmat4 m = reversed_perspective(-0.5, 1.5, -0.25, 1.0, 0.1, 50.0);
    expect_near(project(m, {-0.05, -0.025, -0.1}), {-1.0, -1.0, 1.0});
    expect_near(project(m, {75.0, 50.0, -50.0}), {1.0, 1.0, 0.0});
    expect_near(project(m, {0.5 * 3.0, 0.375 * 3.0, -3.0}), {0.0, 0.0, 0.1 / 3.0 * (47.0 / 49.9)});
}

TEST(Projection, AnInfiniteFarPlaneGivesNearOverDistance) {
    const glm::dmat4 m = reversed_perspective(-1.0, 1.0, -1.0, 1.0, 0.05, kInfinity);
    for (const double d : {0.05, 1.0, 1e4, 1e12}) {
        EXPECT_DOUBLE_EQ(project(m, {0.0, 0.0, -d}).z, 0.05 / d);
    }
}

TEST(Projection, AHugeFiniteFarPlaneTendsToTheInfiniteOne) {
    const glm::dmat4 huge = reversed_perspective(-1.0, 1.0, -1.0, 1.0, 0.05, 1e300);
    const glm::dmat4 infinite = reversed_perspective(-1.0, 1.0, -1.0, 1.0, 0.05, kInfinity);
    EXPECT_DOUBLE_EQ(project(huge, {0.0, 0.0, -3.0}).z, project(infinite, {0.0, 0.0, -3.0}).z);
}

TEST(Projection, DepthFallsWithDistance) {
    const glm::dmat4 m = reversed_perspective(-1.0, 1.0, -1.0, 1.0, 1e-4, 1e8);
    double last = 1.0 + 1e-12;
    for (double d = 1e-4; d < 1e8; d *= 1.01) {
        const double z = project(m, {0.0, 0.0, -d}).z;
        ASSERT_LT(z, last) << d;
        last = z;
    }
}

TEST(Projection, TextureFromClipMapsTheClipBoxToTheUnitCube) {
    const glm::dmat4 m = texture_from_clip();
    expect_near(project(m, {-1.0, -1.0, 0.0}), {0.0, 0.0, 0.0}, 0.0);
    expect_near(project(m, {1.0, 1.0, 1.0}), {1.0, 1.0, 1.0}, 0.0);
    expect_near(project(m, {0.0, 0.5, 0.25}), {0.5, 0.75, 0.25}, 0.0);
}

TEST(Projection, SplitKeepsFortyEightBits) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> mantissa(-2.0, 2.0);
    std::uniform_int_distribution<int> exponent(-60, 60);
    for (int round = 0; round < 20000; ++round) {
        const double v = std::ldexp(mantissa(random), exponent(random));
        const TwoFloat3 s = split(glm::dvec3(v));
        const double sum = static_cast<double>(s.high.x) + static_cast<double>(s.low.x);
        ASSERT_LE(std::abs(sum - v), std::ldexp(std::abs(v), -48)) << v;
        ASSERT_EQ(s.high.x, static_cast<float>(v)) << v;
    }
}

TEST(Projection, SplitOfAFloatHasNoLowPart) {
    const TwoFloat3 s = split({1.5, -0.0, 1e8});
    EXPECT_EQ(s.low, glm::vec3(0.0f));
    EXPECT_EQ(s.high, glm::vec3(1.5f, -0.0f, 1e8f));
    EXPECT_NE(split({1e8 + 1e-3, 0.0, 0.0}).low.x, 0.0f) << "a position between floats needs its low part";
}

TEST(Projection, SplitSaturatesBeyondFloatAndKeepsNan) {
    const TwoFloat3 s = split({1e300, -kInfinity, kNan});
    EXPECT_EQ(s.high.x, std::numeric_limits<float>::max());
    EXPECT_EQ(s.low.x, 0.0f);
    EXPECT_EQ(s.high.y, -std::numeric_limits<float>::max());
    EXPECT_TRUE(std::isnan(s.high.z));
}

}  // namespace
}  // namespace gnomon::math
