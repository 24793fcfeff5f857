#include "systems/shadow/publish/noise_cell.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace gnomon::shadow {
namespace {

constexpr double kCells = 16777216.0;

/// shaders/shadow/filters/disk/noise_seed.glsl, with its floats.
glm::uvec3 cell_of_point(const NoiseCell& camera, const glm::vec3& position_ca, float cell_m) {
    const glm::vec3 axes[3] = {{-0.6666666667f, 0.1333333333f, 0.7333333333f},
                               {0.6666666667f, -0.3333333333f, 0.6666666667f},
                               {0.3333333333f, 0.9333333333f, 0.1333333333f}};
    glm::uvec3 cell;
    for (int i = 0; i < 3; ++i) {
        const float along = (axes[i].x * position_ca.x + axes[i].y * position_ca.y + axes[i].z * position_ca.z) * (1.0f / cell_m) +
                            static_cast<float>(camera.place[i]);
        const float whole = std::floor(along);
        const float wrapped = whole - static_cast<float>(kCells) * std::floor(whole / static_cast<float>(kCells));
        cell[i] = (static_cast<std::uint32_t>(camera.cell[i]) + static_cast<std::uint32_t>(wrapped)) & 0xffffffu;
    }
    return cell;
}

/// Returns the share of points on the ground about `origin` that have another cell once the camera has moved.
double share_that_crawls(const glm::dvec3& origin, const glm::dvec3& step, double ground_m) {
    constexpr double kCell_m = 0.02;
    constexpr int kPoints = 20000;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-10.0, 10.0);
    const glm::dvec3 before = origin + glm::dvec3(0.3, 2.0, 0.1), after = before + step;
    int moved = 0;
    for (int i = 0; i < kPoints; ++i) {
        const glm::dvec3 p = origin + glm::dvec3(place(random), ground_m, place(random));
        moved += cell_of_point(seed_cell(before, kCell_m), glm::vec3(p - before), static_cast<float>(kCell_m)) !=
                 cell_of_point(seed_cell(after, kCell_m), glm::vec3(p - after), static_cast<float>(kCell_m));
    }
    return static_cast<double>(moved) / kPoints;
}

TEST(NoiseCell, APointKeepsItsCellWhileTheCameraWalks) {
    // Rounding: 1e-6 m of 10 m, thrice, against cells of 0.02 m.
    constexpr double kRounded = 1e-3;
    for (const glm::dvec3& origin : {glm::dvec3(0.0), glm::dvec3(1.0e5, -3.0e3, 2.0e5), glm::dvec3(1.0e8, 0.0, -1.0e8)})
        for (const glm::dvec3& step : {glm::dvec3(0.013, 0.0, 0.0), glm::dvec3(1.0, 0.5, -2.0), glm::dvec3(0.0, 1e-4, 0.0)})
            for (const double ground_m : {0.0, 0.02, 1.0})
                EXPECT_LE(share_that_crawls(origin, step, ground_m), origin.x > 1e7 ? 10.0 * kRounded : kRounded) << origin.x << " " << step.x << " " << ground_m;
}

TEST(NoiseCell, NeighboursHaveOtherCellsAndEachLiesWithinItsOwn) {
    const NoiseCell here = seed_cell({5.0, 6.0, 7.0}, 0.02), there = seed_cell({5.03, 6.0, 7.0}, 0.02);
    EXPECT_NE(here.cell, there.cell);
    for (int i = 0; i < 3; ++i) {
        EXPECT_GE(here.place[i], 0.0);
        EXPECT_LT(here.place[i], 1.0);
    }
}

TEST(NoiseCell, FarAwayTheLatticeWrapsInsteadOfOverflowing) {
    for (const double far_m : {-1.0e5, 1.0e8, -1.0e11, 1.0e11}) {
        const NoiseCell at = seed_cell({far_m, far_m, -far_m}, 1e-3);
        for (int i = 0; i < 3; ++i) {
            EXPECT_GE(at.cell[i], 0) << far_m;
            EXPECT_LT(at.cell[i], static_cast<int>(kCells)) << far_m;
        }
    }
}

}  // namespace
}  // namespace gnomon::shadow
