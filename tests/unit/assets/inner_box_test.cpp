#include "engine/mesh/inner_box.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <numeric>
#include <random>

#include "engine/math/aabb.h"
#include "tests/unit/assets/cube_mesh.h"
#include "tests/unit/math/random_seed.h"

/// Boxes inside of closed meshes: every point of one is inside by its winding number, and closed rooms give large ones.
namespace gnomon::assets {
namespace {

Mesh completed(Mesh mesh) {
    mesh.submeshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    complete(mesh);
    return mesh;
}

Mesh box_mesh(const glm::vec3& low, const glm::vec3& high) {
    std::vector<glm::vec3> corners = kCorners;
    for (glm::vec3& corner : corners) corner = low + corner * (high - low);
    return mesh_of(corners, kCubeFaces);
}

void add(Mesh& to, const Mesh& part) {
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    to.vertices.insert(to.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const std::uint32_t index : part.indices) to.indices.push_back(first + index);
}

/// Returns how often the mesh winds around a point: the sum of its triangles' solid angles (Van Oosterom and Strackee
/// 1983), over 4 pi.
double winding(const Mesh& mesh, const glm::dvec3& at) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<glm::dvec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = glm::dvec3(mesh.vertices[mesh.indices[i + k]].position_ms) - at;
        const double a = glm::length(p[0]), b = glm::length(p[1]), c = glm::length(p[2]);
        sum += std::atan2(glm::dot(p[0], glm::cross(p[1], p[2])),
                          a * b * c + glm::dot(p[0], p[1]) * c + glm::dot(p[1], p[2]) * a + glm::dot(p[2], p[0]) * b);
    }
    return sum / (2.0 * glm::pi<double>());
}

/// Returns a closed surface around the origin, as far from it in each direction as `radius` returns: rings of a ball.
template <class Radius>
Mesh around_origin(std::uint32_t sides, std::uint32_t rings, const Radius& radius) {
    std::vector<glm::vec3> places;
    std::vector<std::uint32_t> faces;
    const auto put = [&](const glm::dvec3& direction) { places.emplace_back(direction * radius(direction)); };
    put({0.0, -1.0, 0.0});
    for (std::uint32_t ring = 1; ring < rings; ++ring)
        for (std::uint32_t side = 0; side < sides; ++side) {
            const double up = glm::pi<double>() * ring / rings, turn = glm::two_pi<double>() * side / sides;
            put({std::sin(up) * std::cos(turn), -std::cos(up), std::sin(up) * std::sin(turn)});
        }
    put({0.0, 1.0, 0.0});
    const auto at = [&](std::uint32_t ring, std::uint32_t side) { return 1 + (ring - 1) * sides + side % sides; };
    const auto top = static_cast<std::uint32_t>(places.size() - 1);
    for (std::uint32_t side = 0; side < sides; ++side) {
        faces.insert(faces.end(), {0, at(1, side), at(1, side + 1)});
        faces.insert(faces.end(), {top, at(rings - 1, side + 1), at(rings - 1, side)});
        for (std::uint32_t ring = 1; ring + 1 < rings; ++ring)
            faces.insert(faces.end(), {at(ring, side), at(ring + 1, side), at(ring + 1, side + 1), at(ring, side),
                                       at(ring + 1, side + 1), at(ring, side + 1)});
    }
    return completed(mesh_of(places, faces));
}

void expect_near(const math::Aabb& box, const glm::dvec3& low, const glm::dvec3& high, double off) {
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(box.min[axis], low[axis], off) << axis;
        EXPECT_NEAR(box.max[axis], high[axis], off) << axis;
        EXPECT_GT(box.min[axis], low[axis]) << "it touches the mesh";
        EXPECT_LT(box.max[axis], high[axis]) << "it touches the mesh";
    }
}

TEST(InnerBox, OfABoxIsNearlyAllOfIt) {
    expect_near(completed(box_mesh({-7.0f, -0.3f, -6.5f}, {7.0f, 30.0f, 6.5f})).inner_ms, {-7.0, -0.3, -6.5},
                {7.0, 30.0, 6.5}, 0.01);
    // At other sizes, and far from its own origin.
    expect_near(completed(box_mesh(glm::vec3(1.0e-4f), glm::vec3(2.0e-4f))).inner_ms, glm::dvec3(1.0e-4f),
                glm::dvec3(2.0e-4f), 1.0e-8);
    expect_near(completed(box_mesh(glm::vec3(5.0e6f), glm::vec3(6.0e6f))).inner_ms, glm::dvec3(5.0e6),
                glm::dvec3(6.0e6), 200.0);
}

TEST(InnerBox, IsInTheLargestPartAndMayMeetOthers) {
    Mesh house = box_mesh({-7.0f, 0.0f, -6.5f}, {7.0f, 20.0f, 6.5f});
    add(house, box_mesh({-6.3f, 1.0f, -6.6f}, {6.3f, 2.5f, 6.6f}));    // a band of windows, through all of it
    add(house, box_mesh({-7.5f, 19.5f, -7.0f}, {7.5f, 20.1f, 7.0f}));  // a ledge
    expect_near(completed(house).inner_ms, {-7.0, 0.0, -6.5}, {7.0, 20.0, 6.5}, 0.01);
}

TEST(InnerBox, IsEmptyWithoutAnInside) {
    EXPECT_TRUE(math::is_empty(completed(Mesh{}).inner_ms));
    Mesh open = mesh_of(kCorners, kCubeFaces);
    open.indices.resize(open.indices.size() - 3);
    EXPECT_TRUE(math::is_empty(completed(open).inner_ms));
    Mesh inward = mesh_of(kCorners, kCubeFaces);
    for (std::size_t i = 0; i < inward.indices.size(); i += 3) std::swap(inward.indices[i], inward.indices[i + 1]);
    EXPECT_TRUE(math::is_empty(completed(inward).inner_ms));
    Mesh broken = mesh_of(kCorners, kCubeFaces);
    broken.vertices[3].position_ms.y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(math::is_empty(completed(broken).inner_ms));
    // A room: what is outside of its inner wall lies inside of the outer one, what is in the room does not.
    Mesh room = box_mesh(glm::vec3(0.0f), glm::vec3(10.0f));
    Mesh inside = box_mesh(glm::vec3(1.0f), glm::vec3(9.0f));
    for (std::size_t i = 0; i < inside.indices.size(); i += 3) std::swap(inside.indices[i], inside.indices[i + 1]);
    add(room, inside);
    EXPECT_TRUE(math::is_empty(completed(room).inner_ms));
}

TEST(InnerBox, IsNotSoughtInMeshesOfVeryManyTriangles) {
    const auto round = [](const glm::dvec3&) { return 1.0; };
    EXPECT_FALSE(math::is_empty(around_origin(90, 90, round).inner_ms));
    EXPECT_TRUE(math::is_empty(around_origin(92, 91, round).inner_ms));
}

TEST(InnerBox, OfABallIsMuchOfIt) {
    const math::Aabb box = around_origin(32, 16, [](const glm::dvec3&) { return 1.0; }).inner_ms;
    ASSERT_FALSE(math::is_empty(box));
    const glm::dvec3 side = box.max - box.min;
    EXPECT_GT(side.x * side.y * side.z, 0.8) << "the largest has 1.54";
}

TEST(InnerBox, IsInsideOfRandomSurfacesAtEveryPoint) {
    std::mt19937_64 random(print_seed());
    const auto number = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    int found = 0;
    for (int round = 0; round < 150; ++round) {
        std::array<glm::dvec3, 5> waves;
        for (glm::dvec3& wave : waves) wave = {number(-4.0, 4.0), number(-4.0, 4.0), number(-4.0, 4.0)};
        const glm::dvec3 stretch(number(0.2, 2.0), number(0.2, 2.0), number(0.2, 2.0));
        const auto radius = [&](const glm::dvec3& direction) {
            double sum = 0.0;
            for (const glm::dvec3& wave : waves) sum += std::sin(glm::dot(wave, direction) + wave.x);
            return (1.0 + 0.18 * sum) * glm::length(stretch * direction);
        };
        const Mesh mesh = around_origin(12, 9, radius);
        if (math::is_empty(mesh.inner_ms)) continue;
        ++found;
        for (int k = 0; k < 60; ++k) {
            glm::dvec3 at;
            for (int axis = 0; axis < 3; ++axis) {
                const double share = number(-0.5, 1.5);  // half of them on its sides
                at[axis] = glm::mix(mesh.inner_ms.min[axis], mesh.inner_ms.max[axis], glm::clamp(share, 0.0, 1.0));
            }
            EXPECT_NEAR(winding(mesh, at), 1.0, 1.0e-6) << "round " << round;
        }
    }
    EXPECT_GT(found, 120);
}

}  // namespace
}  // namespace gnomon::assets
