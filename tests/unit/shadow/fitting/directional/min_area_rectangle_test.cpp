#include "systems/shadow/fitting/directional/min_area_rectangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/unit/math/random_seed.h"

namespace gnomon::shadow {
namespace {

double area(const Rectangle& r) { return (r.max.x - r.min.x) * (r.max.y - r.min.y); }

glm::dvec2 within(const Rectangle& r, const glm::dvec2& p) {
    return {glm::dot(p, r.axis_u), r.axis_u.x * p.y - r.axis_u.y * p.x};
}

/// Computes the area of the box around the points, turned by an angle.
double turned_area(std::span<const glm::dvec2> points, double angle_rad) {
    Rectangle r;
    r.axis_u = {std::cos(angle_rad), std::sin(angle_rad)};
    r.min = glm::dvec2(std::numeric_limits<double>::infinity());
    r.max = -r.min;
    for (const glm::dvec2& p : points) r.min = glm::min(r.min, within(r, p)), r.max = glm::max(r.max, within(r, p));
    return area(r);
}

TEST(SmallestRectangle, HoldsAllPointsAndNoTurnedBoxIsSmaller) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    std::vector<glm::dvec2> hull;
    for (int round = 0; round < 300; ++round) {
        std::vector<glm::dvec2> points(3 + static_cast<std::size_t>(round) % 40);
        const glm::dvec2 stretch(1.0, std::exp2(-round % 12)), place(1000.0 * number(random), number(random));
        const double turn = 3.0 * number(random);
        for (glm::dvec2& p : points) {
            const glm::dvec2 q = glm::dvec2(number(random), number(random)) * stretch;
            p = place + glm::dvec2(std::cos(turn) * q.x - std::sin(turn) * q.y, std::sin(turn) * q.x + std::cos(turn) * q.y);
        }
        const std::vector<glm::dvec2> original = points;
        const Rectangle r = smallest_rectangle(points, hull);
        EXPECT_NEAR(glm::length(r.axis_u), 1.0, 1e-14);
        const double slack = 1e-12 * 1000.0;  // rounding at the coordinates' size
        for (const glm::dvec2& p : original) {
            const glm::dvec2 q = within(r, p);
            EXPECT_TRUE(q.x >= r.min.x - slack && q.y >= r.min.y - slack && q.x <= r.max.x + slack && q.y <= r.max.y + slack);
        }
        constexpr int kAngles = 2000;
        double best = std::numeric_limits<double>::infinity();
        for (int i = 0; i < kAngles; ++i) best = std::min(best, turned_area(original, 0.5 * 3.14159265358979 * i / kAngles));
        EXPECT_LE(area(r), best * (1.0 + 2.0 / (1 << 20)) + slack);
    }
}

TEST(SmallestRectangle, OfATurnedSquareIsTheSquare) {
    std::vector<glm::dvec2> points = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0, 0}};
    std::vector<glm::dvec2> hull;
    EXPECT_NEAR(area(smallest_rectangle(points, hull)), 2.0, 1e-14);
}

TEST(SmallestRectangle, IsTotal) {
    std::vector<glm::dvec2> hull;
    std::vector<glm::dvec2> none, one = {{3, 4}}, same(5, {3, 4}), line = {{0, 0}, {1, 1}, {2, 2}, {1, 1}};
    const Rectangle empty = smallest_rectangle(none, hull);
    EXPECT_GT(empty.min.x, empty.max.x);
    for (auto* points : {&one, &same}) {
        const Rectangle r = smallest_rectangle(*points, hull);
        EXPECT_EQ(r.min, r.max);
        EXPECT_EQ(area(r), 0.0);
    }
    const Rectangle r = smallest_rectangle(line, hull);
    EXPECT_NEAR(area(r), 0.0, 1e-14);
    EXPECT_NEAR(std::max(r.max.x - r.min.x, r.max.y - r.min.y), 2.0 * std::sqrt(2.0), 1e-14);
}

TEST(SmallestRectangle, AnEdgeThatRoundingMadeDecidesNothing) {
    // Right-angled triangle: every side gives a rectangle of the same area, so the first one stays. At one corner a second
    // point, one rounding apart, in any direction.
    constexpr double kSlack = 1e-9;
    std::vector<glm::dvec2> hull;
    std::vector<glm::dvec2> plain = {{0.0, 0.0}, {3.0, 0.5}, {2.5, 3.5}};
    const Rectangle wanted = smallest_rectangle(plain, hull, kSlack);
    for (int step = 0; step < 64; ++step) {
        const double angle = 0.1 * step;
        std::vector<glm::dvec2> split = {{0.0, 0.0}, {3.0, 0.5}, {2.5, 3.5}, {3.0 + 1e-10 * std::cos(angle), 0.5 + 1e-10 * std::sin(angle)}};
        const Rectangle found = smallest_rectangle(split, hull, kSlack);
        EXPECT_NEAR(std::abs(glm::dot(found.axis_u, wanted.axis_u)), 1.0, 1e-9) << angle;
        EXPECT_GE(area(found), area(wanted) * (1.0 - 1e-9));
    }
}

}  // namespace
}  // namespace gnomon::shadow
