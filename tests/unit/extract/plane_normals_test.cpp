#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "systems/extract/gpu_scene.h"
#include "tests/unit/math/random_seed.h"

namespace gnomon {
namespace {

using Corners = std::array<glm::vec3, 3>;

glm::vec4 normal_of(const Corners& corners) {
    std::vector<assets::Vertex> vertices(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) vertices[i].position_ms = corners[i];
    std::vector<glm::vec4> normals;
    append_plane_normals(vertices, std::vector<std::uint32_t>{0, 1, 2}, normals);
    return normals.at(0);
}

/// Adds the residual as plane_normal() in shaders/lighting/gbuffer/surface_position_f64.glsl does.
glm::dvec3 with_residual(const glm::vec4& normal) {
    const auto bits = std::bit_cast<std::uint32_t>(normal.w);
    glm::dvec3 whole(normal);
    for (int axis = 0; axis < 3; ++axis) {
        const auto upmost = static_cast<std::int32_t>(bits << (22 - 10 * axis));
        whole[axis] += (upmost >> 22) * (0x1p-25 / 511.0);
    }
    return whole;
}

TEST(PlaneNormals, AreRightToTwoToTheMinus35AlongEachAxisWithTheirResidual) {
    std::mt19937_64 random(print_seed());
    std::uniform_real_distribution<float> side(-10.0f, 10.0f);
    double rounded_off = 0.0;
    for (int i = 0; i < 10000; ++i) {
        Corners corners;
        for (glm::vec3& corner : corners) corner = {side(random), side(random), side(random)};
        const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
        const glm::dvec3 exact = glm::normalize(glm::cross(b - a, c - a));
        const glm::vec4 normal = normal_of(corners);
        const glm::dvec3 off = glm::abs(with_residual(normal) - exact);
        ASSERT_LE(std::max({off.x, off.y, off.z}), 1.01 * 0x1p-35) << "triangle " << i;
        const glm::dvec3 rounded = glm::abs(glm::dvec3(normal) - exact);
        rounded_off = std::max({rounded_off, rounded.x, rounded.y, rounded.z});
    }
    EXPECT_GT(rounded_off, 0x1p-26) << "floats alone would do";
}

TEST(PlaneNormals, OfAxesAndOfNothingAreWhole) {
    EXPECT_EQ(normal_of({glm::vec3(0.0f), {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}}), glm::vec4(0.0f, 0.0f, 1.0f, 0.0f));
    EXPECT_EQ(normal_of({glm::vec3(1.0f), glm::vec3(2.0f), glm::vec3(3.0f)}), glm::vec4(0.0f)) << "no area";
}

}  // namespace
}  // namespace gnomon
