#include "engine/math/shape_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/unit/math/random_seed.h"
#include "tests/unit/not_finite.h"

namespace gnomon::math {
namespace {

using Triangle = std::array<glm::vec3, 3>;

class Random {
public:
    explicit Random(std::uint64_t seed) : random_(seed) {}
    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
    glm::dvec3 vector(double reach) { return {number(-reach, reach), number(-reach, reach), number(-reach, reach)}; }
    glm::dvec3 direction() {
        glm::dvec3 d;
        do d = vector(1.0);
        while (!(glm::length(d) > 0.05));
        return glm::normalize(d);
    }
    /// Draws triangles: small, long, flat, and some that are a point.
    std::vector<Triangle> triangles(std::size_t count) {
        std::vector<Triangle> all;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 place = vector(10.0);
            const double size = i % 7 == 0 ? 0.0 : i % 5 == 0 ? 20.0 : 0.5;
            Triangle t;
            for (glm::vec3& corner : t) {
                corner = glm::vec3(place + vector(size));
                if (i % 3 == 0) corner.y = static_cast<float>(place.y);
            }
            all.push_back(t);
        }
        return all;
    }
    Frustum frustum(double near_m) {
        const glm::dvec3 place = vector(8.0);
        const glm::dmat3 rotation = basis_from_back(direction());
        const double far_m = number(0.0, 1.0) < 0.3 ? kInfinity : number(2.0, 30.0);
        if (number(0.0, 1.0) < 0.3) return orthographic_frustum(place, rotation, 2.0, 1.5, near_m, far_m);
        return perspective_frustum(place, rotation, number(0.05, 2.0), number(0.05, 2.0), near_m, far_m);
    }

private:
    std::mt19937_64 random_;
};

FloatBox box_of(const Triangle& t) {
    return {glm::min(t[0], glm::min(t[1], t[2])), glm::max(t[0], glm::max(t[1], t[2]))};
}

ShapeTree tree_of(const std::vector<Triangle>& triangles) {
    std::vector<FloatBox> boxes;
    for (const Triangle& t : triangles) boxes.push_back(box_of(t));
    return ShapeTree(boxes);
}

bool is_inside(const Frustum& frustum, const glm::dvec3& p) {
    const auto planes = planes_of(frustum);
    return std::all_of(planes.begin(), planes.end(),
                       [&](const Plane& plane) { return glm::dot(plane.normal, p) + plane.offset >= 0.0; });
}

double at(const Ramp& ramp, const glm::dvec3& p) { return glm::dot(ramp.gradient, p) + ramp.offset; }

Ramp scaled(Ramp ramp, double by) {
    ramp.offset *= by;
    return ramp;
}

/// Returns the least value of `ramp` at many points of the triangles within the frustum; infinity if none lies there.
double lowest_sample(const std::vector<Triangle>& triangles, const Frustum& frustum, const Ramp& ramp, Random& random) {
    double lowest = kInfinity;
    for (const Triangle& t : triangles)
        for (int i = 0; i < 60; ++i) {
            double u = random.number(0.0, 1.0), v = random.number(0.0, 1.0);
            if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
            if (i < 3) u = i == 1 ? 1.0 : 0.0, v = i == 2 ? 1.0 : 0.0;
            const glm::dvec3 a(t[0]), b(t[1]), c(t[2]);
            const glm::dvec3 p = a * (1.0 - u - v) + b * u + c * v;
            if (is_inside(frustum, p)) lowest = std::min(lowest, at(ramp, p));
        }
    return lowest;
}

TEST(ShapeTree, IsNeverAboveAPointOfATriangleThatThePlanesHold) {
    Random random(print_seed());
    std::vector<glm::dvec3> scratch;
    int seen = 0, unseen = 0;
    for (int round = 0; round < 400; ++round) {
        const std::vector<Triangle> triangles = random.triangles(static_cast<std::size_t>(random.number(1.0, 120.0)));
        const Frustum frustum = random.frustum(random.number(0.0, 2.0));
        const Ramp ramp{random.vector(3.0), random.number(-5.0, 5.0)};
        const double found = tree_of(triangles).lowest(ramp, planes_of(frustum), kInfinity, scratch);
        const double sampled = lowest_sample(triangles, frustum, ramp, random);
        ASSERT_LE(found, sampled) << "round " << round;
        ++(std::isfinite(sampled) ? seen : unseen);
    }
    EXPECT_GT(seen, 200);
    EXPECT_GT(unseen, 5);
}

TEST(ShapeTree, WouldBeCaughtIfItForgotTheLowestTriangle) {
    Random random(print_seed());
    std::vector<glm::dvec3> scratch;
    int caught = 0;
    for (int round = 0; round < 100; ++round) {
        std::vector<Triangle> triangles;  // small ones, so that the box of no other one is around the lowest
        for (int i = 0; i < 60; ++i) {
            const glm::dvec3 place = random.vector(10.0);
            triangles.push_back({glm::vec3(place), glm::vec3(place + random.vector(0.1)), glm::vec3(place)});
        }
        const Ramp ramp{random.direction(), 0.0};
        const auto lowest = std::min_element(triangles.begin(), triangles.end(), [&](const auto& a, const auto& b) {
            return at(ramp, glm::dvec3(a[0])) < at(ramp, glm::dvec3(b[0]));
        });
        const double sampled = at(ramp, glm::dvec3((*lowest)[0]));
        triangles.erase(lowest);
        caught += tree_of(triangles).lowest(ramp, {}, kInfinity, scratch) > sampled ? 1 : 0;
    }
    EXPECT_GT(caught, 60);
}

TEST(ShapeTree, IsWhatLookingAtEveryBoxFindsWherePartsLieApart) {
    Random random(print_seed());
    std::vector<glm::dvec3> scratch;
    for (int round = 0; round < 200; ++round) {
        std::vector<FloatBox> boxes;
        const auto count = static_cast<int>(random.number(1.0, 60.0));
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 place = random.vector(10.0);
            const FloatBox box{glm::vec3(place), glm::vec3(place + glm::abs(random.vector(1.0)))};
            boxes.push_back(box);
        }
        const Frustum frustum = random.frustum(0.1);
        const Ramp ramp{random.vector(3.0), random.number(-5.0, 5.0)};
        double wanted = kInfinity;
        for (const FloatBox& box : boxes)
            wanted = lowest_in({glm::dvec3(box.min), glm::dvec3(box.max)}, ramp, planes_of(frustum), wanted, scratch);
        EXPECT_EQ(ShapeTree(boxes).lowest(ramp, planes_of(frustum), kInfinity, scratch), wanted);
    }
}

TEST(ShapeTree, StopsAtWhatIsKnownAlready) {
    std::vector<glm::dvec3> scratch;
    const std::vector<Triangle> one = {{glm::vec3(0.0f), glm::vec3(1.0f, 0.0f, 0.0f), glm::vec3(0.0f, 1.0f, 0.0f)}};
    const Ramp ramp{{0.0, 0.0, 1.0}, 5.0};
    const ShapeTree tree = tree_of(one);
    EXPECT_NEAR(tree.lowest(ramp, {}, kInfinity, scratch), 5.0, 1e-5);
    EXPECT_LT(tree.lowest(ramp, {}, kInfinity, scratch), 5.0) << "a GPU rounds";
    EXPECT_EQ(tree.lowest(ramp, {}, 4.0, scratch), 4.0);
    const Plane elsewhere{{1.0, 0.0, 0.0}, -2.0};
    EXPECT_EQ(tree.lowest(ramp, {&elsewhere, 1}, kInfinity, scratch), kInfinity);
}

TEST(ShapeTree, OfNothingHasNoLowest) {
    std::vector<glm::dvec3> scratch;
    EXPECT_TRUE(ShapeTree().empty());
    EXPECT_TRUE(ShapeTree(std::vector<FloatBox>{}).empty());
    EXPECT_EQ(ShapeTree().lowest({{1.0, 0.0, 0.0}, 0.0}, {}, kInfinity, scratch), kInfinity);
    EXPECT_EQ(ShapeTree().bytes(), 0u);
}

TEST(ShapeTree, ScalesByPowersOfTwoToTheBit) {
    Random random(print_seed());
    std::vector<glm::dvec3> scratch;
    for (int round = 0; round < 100; ++round) {
        const std::vector<Triangle> triangles = random.triangles(70);
        const Frustum frustum = random.frustum(0.5);
        const Ramp ramp{random.direction(), random.number(-5.0, 5.0)};
        const double found = tree_of(triangles).lowest(ramp, planes_of(frustum), kInfinity, scratch);
        for (const int power : {-30, -1, 26}) {
            const double by = std::exp2(power);
            std::vector<Triangle> larger = triangles;
            for (Triangle& t : larger)
                for (glm::vec3& corner : t) corner *= static_cast<float>(by);
            Frustum wider = frustum;
            for (Plane& plane : wider.planes) plane.offset *= by;
            EXPECT_EQ(tree_of(larger).lowest(scaled(ramp, by), planes_of(wider), kInfinity, scratch), found * by);
        }
    }
}

TEST(ShapeTree, TakesEightBytesPerTriangleOfAFineMeshAndAtMostSixtyFour) {
    std::vector<FloatBox> fine;
    for (int i = 0; i < 256; ++i)
        for (int k = 0; k < 512; ++k) fine.push_back({glm::vec3(i, k / 2, 0), glm::vec3(i + 1, k / 2 + 1, 0)});
    EXPECT_LE(ShapeTree(fine).bytes(), 8 * fine.size());
    Random random(1);
    EXPECT_LE(tree_of(random.triangles(1000)).bytes(), 64000u);
}

}  // namespace
}  // namespace gnomon::math
