#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "shaders/embedded.h"
#include "systems/shadow/request/filter_settings.h"

// The table of points in the shader's own text.
namespace gnomon::shadow {
namespace {

std::vector<glm::dvec2> points_of_the_shader() {
    std::vector<glm::dvec2> points;
    for (const gl::ShaderFile& file : shader_files()) {
        if (file.path != "shadow/filters/disk/poisson_disk.glsl") continue;
        const std::string text(file.text.substr(file.text.find('{')));
        for (std::size_t at = text.find("vec2("); at != std::string::npos; at = text.find("vec2(", at + 1)) {
            char* rest = nullptr;
            const double x = std::strtod(text.c_str() + at + 5, &rest);
            points.emplace_back(x, std::strtod(rest + 1, nullptr));
        }
    }
    return points;
}

double nearest(const std::vector<glm::dvec2>& points, std::size_t count, const glm::dvec2& p) {
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < count; ++i) least = std::min(least, glm::distance(points[i], p));
    return least;
}

constexpr int kLattice = 64;
constexpr double kBeyondRim = 0.3;

/// Computes what the method stated beside the table makes as large as it can be.
double merit(const std::vector<glm::dvec2>& points, std::size_t count, const glm::dvec2& p) {
    return std::min(nearest(points, count, p), 2.0 * (1.0 - glm::length(p)) + kBeyondRim);
}

double best_merit(const std::vector<glm::dvec2>& points, std::size_t count) {
    double best = 0.0;
    for (int x = -kLattice; x <= kLattice; ++x)
        for (int y = -kLattice; y <= kLattice; ++y)
            if (x * x + y * y <= kLattice * kLattice)
                best = std::max(best, merit(points, count, glm::dvec2(x, y) / double{kLattice}));
    return best;
}

TEST(PoissonDisk, EachPointIsTheOneTheStatedMethodChooses) {
    const std::vector<glm::dvec2> points = points_of_the_shader();
    ASSERT_EQ(points.size(), kMostFilterTaps);
    EXPECT_EQ(points[0], glm::dvec2(0.5, 0.25));
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec2 on_lattice = points[i] * double{kLattice};
        EXPECT_EQ(on_lattice, glm::round(on_lattice)) << i;
        EXPECT_GE(merit(points, i, points[i]), best_merit(points, i) - 1e-12) << i;
    }
    EXPECT_LT(merit(points, 4, {0.0, 0.9}), best_merit(points, 4) - 0.05) << "any other would do as well";
}

TEST(PoissonDisk, EachOfTheUsualCountsFillsTheDiskAndKeepsItsPointsApart) {
    const std::vector<glm::dvec2> points = points_of_the_shader();
    ASSERT_EQ(points.size(), kMostFilterTaps);
    for (const std::size_t count : {4u, 8u, 16u, 32u}) {
        double apart = HUGE_VAL, radius = 0.0, mean_square = 0.0;
        glm::dvec2 mean(0.0);
        for (std::size_t i = 0; i < count; ++i) {
            radius = std::max(radius, glm::length(points[i]));
            mean += points[i] / static_cast<double>(count);
            mean_square += glm::dot(points[i], points[i]) / static_cast<double>(count);
            apart = std::min(apart, nearest(points, i, points[i]));
        }
        EXPECT_LE(radius, 1.0) << count;
        EXPECT_GE(radius, count == 4 ? 0.69 : 0.84) << count;
        // Points on a square lattice over the disk are sqrt(pi / n) = 1.77 / sqrt(n) apart.
        EXPECT_GE(apart * std::sqrt(static_cast<double>(count)), 1.5) << count;
        EXPECT_LE(glm::length(mean), 0.06) << count << ": the disk is pushed aside";
        EXPECT_NEAR(mean_square, 0.5, 0.12) << count << ": a uniform disk has 1/2";
    }
}

}  // namespace
}  // namespace gnomon::shadow
