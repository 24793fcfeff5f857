#include "systems/shadow/fitting/light_space_extents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <vector>

#include "engine/math/frustum.h"
#include "tests/unit/math/random_seed.h"

namespace gnomon::shadow {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Extents one_by_one(const glm::dmat3& axes, const std::vector<glm::dvec3>& points) {
    Extents all{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
    for (const glm::dvec3& p : points) {
        all.low = glm::min(all.low, p * axes);
        all.high = glm::max(all.high, p * axes);
    }
    return all;
}

void expect_as_one_by_one(const glm::dmat3& axes, const std::vector<glm::dvec3>& points) {
    const Extents all = extents_along(axes, points), one = one_by_one(axes, points);
    EXPECT_EQ(all.low, one.low) << points.size() << " points";
    EXPECT_EQ(all.high, one.high) << points.size() << " points";
}

class ExtentsAlong : public ::testing::Test {
protected:
    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }
    glm::dvec3 vector() { return {number(-1.0, 1.0), number(-1.0, 1.0), number(-1.0, 1.0)}; }
    /// Boxes' corners around a place, each of another size.
    std::vector<glm::dvec3> points(std::size_t count) {
        const glm::dvec3 place = vector() * std::exp2(number(-10.0, 30.0)), spread = vector() * 100.0;
        std::vector<glm::dvec3> all;
        while (all.size() < count) {
            const glm::dvec3 centre = place + spread * vector(), half = vector() * std::exp2(number(-30.0, 6.0));
            for (int i = 0; i < 8 && all.size() < count; ++i)
                all.push_back(centre + half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
        }
        return all;
    }
    std::mt19937_64 random{print_seed()};
};

TEST_F(ExtentsAlong, AreThoseOfThePointsOneByOneToTheBit) {
    for (int round = 0; round < 2000; ++round) {
        const glm::dmat3 axes = math::basis_from_back(round % 8 == 0 ? glm::dvec3(0, 1, 0) : vector());
        expect_as_one_by_one(axes, points(static_cast<std::size_t>(number(0.0, 600.0))));
    }
}

TEST_F(ExtentsAlong, FindTheOnePointThatReachesFarthest) {
    for (int round = 0; round < 2000; ++round) {
        const glm::dmat3 axes = math::basis_from_back(vector());
        std::vector<glm::dvec3> all(200, glm::dvec3(1e6));
        glm::dvec3& farthest = all[static_cast<std::size_t>(number(0.0, 200.0))];
        farthest[round % 3] = std::nextafter(farthest[round % 3], round % 2 ? kInfinity : -kInfinity);
        expect_as_one_by_one(axes, all);
    }
}

TEST_F(ExtentsAlong, LeaveOutWhatIsNotANumber) {
    const glm::dmat3 axes = math::basis_from_back(vector());
    for (const std::size_t at : {0u, 1u, 31u, 32u, 100u}) {
        std::vector<glm::dvec3> all = points(128);
        all[at].y = std::numeric_limits<double>::quiet_NaN();
        expect_as_one_by_one(axes, all);
        all[at] = glm::dvec3(kInfinity, 0.0, -kInfinity);
        expect_as_one_by_one(axes, all);
    }
    expect_as_one_by_one(axes, {});
}

}  // namespace
}  // namespace gnomon::shadow
