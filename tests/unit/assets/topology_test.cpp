#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <random>

#include "engine/assets/openmesh_parts.h"
#include "engine/mesh/mesh_topology.h"
#include "tests/unit/assets/cube_mesh.h"

namespace gnomon::test {
namespace {

using assets::fill_normals;
using assets::kCorners;
using assets::kCubeFaces;
using assets::Mesh;
using assets::mesh_of;
using assets::Topology;

/// Analyses the mesh in both ways, which have to agree.
Topology topology_of(const Mesh& mesh) {
    const Topology own = assets::analyse_topology(mesh);
    const Topology by_openmesh = assets::analyse_topology(mesh, assets::openmesh_parts);
    EXPECT_EQ(own, by_openmesh);
    return own;
}

Mesh cube() { return mesh_of(kCorners, kCubeFaces); }

/// Gives every face its own three vertices, as files with hard edges have them.
Mesh split(const Mesh& mesh) {
    Mesh apart;
    for (const std::uint32_t index : mesh.indices) {
        apart.indices.push_back(static_cast<std::uint32_t>(apart.vertices.size()));
        apart.vertices.push_back(mesh.vertices[index]);
    }
    return apart;
}

Mesh joined(const Mesh& a, const Mesh& b, const glm::vec3& offset) {
    Mesh both = a;
    for (const std::uint32_t index : b.indices) {
        both.indices.push_back(index + static_cast<std::uint32_t>(a.vertices.size()));
    }
    for (assets::Vertex vertex : b.vertices) {
        vertex.position_ms += offset;
        both.vertices.push_back(vertex);
    }
    return both;
}

TEST(Topology, CallsACubeClosed) {
    const Topology topology = topology_of(cube());
    EXPECT_TRUE(topology.closed);
    EXPECT_EQ(topology.boundary_edges, 0U);
    EXPECT_EQ(topology.non_manifold_edges, 0U);
    EXPECT_EQ(topology.degenerate_faces, 0U);
    EXPECT_EQ(topology.components, 1U);
}

TEST(Topology, OpensACubeWhenOneFaceIsTakenAway) {
    Mesh mesh = cube();
    mesh.indices.resize(mesh.indices.size() - 3);
    const Topology topology = topology_of(mesh);
    EXPECT_FALSE(topology.closed);
    EXPECT_EQ(topology.boundary_edges, 3U);
}

TEST(Topology, WeldsVerticesWithIdenticalPositionBits) {
    const Topology topology = topology_of(split(cube()));
    EXPECT_TRUE(topology.closed);
    EXPECT_EQ(topology.components, 1U);
}

TEST(Topology, TakesMinusZeroAndZeroForTheSame) {
    Mesh mesh = split(cube());
    for (std::size_t i = 0; i < mesh.vertices.size(); i += 2) {
        glm::vec3& p = mesh.vertices[i].position_ms;
        for (int axis = 0; axis < 3; ++axis) p[axis] = p[axis] == 0.0F ? -0.0F : p[axis];
    }
    EXPECT_TRUE(topology_of(mesh).closed);
}

TEST(Topology, DoesNotWeldPositionsThatDifferByOneBit) {
    Mesh mesh = split(cube());
    mesh.vertices[1].position_ms.y = std::nextafter(mesh.vertices[1].position_ms.y, 2.0F);
    const Topology topology = topology_of(mesh);
    EXPECT_FALSE(topology.closed);
    EXPECT_EQ(topology.boundary_edges, 4U) << "two edges of the moved face, two of its neighbours";
}

TEST(Topology, CountsTheBoundaryOfAnOpenQuad) {
    const Topology topology = topology_of(mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3}));
    EXPECT_FALSE(topology.closed);
    EXPECT_EQ(topology.boundary_edges, 4U);
    EXPECT_EQ(topology.components, 1U);
}

TEST(Topology, CountsAFinAsOneNonManifoldEdge) {
    const Topology topology =
        topology_of(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {0, 1, 2, 1, 0, 3, 0, 1, 4}));
    EXPECT_EQ(topology.non_manifold_edges, 1U);
    EXPECT_EQ(topology.boundary_edges, 6U);
    EXPECT_EQ(topology.components, 1U);
    EXPECT_FALSE(topology.closed);
}

TEST(Topology, CountsTheEdgeThatTwoCubesShare) {
    const Topology topology = topology_of(joined(cube(), cube(), {1, 1, 0}));
    EXPECT_EQ(topology.non_manifold_edges, 1U);
    EXPECT_EQ(topology.boundary_edges, 0U);
    EXPECT_FALSE(topology.closed);
    EXPECT_EQ(topology.components, 1U);
}

TEST(Topology, CallsTwoCubesThatTouchInAPointClosed) {
    const Topology topology = topology_of(joined(cube(), cube(), {1, 1, 1}));
    EXPECT_TRUE(topology.closed);
    EXPECT_EQ(topology.components, 2U);
}

TEST(Topology, CountsComponents) {
    EXPECT_EQ(topology_of(joined(joined(cube(), cube(), {5, 0, 0}), cube(), {0, 5, 0})).components, 3U);
}

TEST(Topology, CountsEdgesOfInconsistentWindingAsNonManifold) {
    Mesh mesh = cube();
    std::swap(mesh.indices[0], mesh.indices[1]);
    const Topology topology = topology_of(mesh);
    EXPECT_FALSE(topology.closed);
    EXPECT_EQ(topology.non_manifold_edges, 3U);
    EXPECT_EQ(topology.boundary_edges, 0U);
}

TEST(Topology, FindsTheSeamOfAMoebiusStrip) {
    constexpr std::uint32_t kSteps = 12;
    std::vector<glm::vec3> positions;
    for (std::uint32_t i = 0; i < kSteps; ++i) {
        const float turn = glm::two_pi<float>() * static_cast<float>(i) / kSteps;
        for (const float side : {-0.3F, 0.3F}) {
            const float radius = 1.0F + side * std::cos(turn / 2);
            positions.emplace_back(radius * std::cos(turn), radius * std::sin(turn), side * std::sin(turn / 2));
        }
    }
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < kSteps; ++i) {
        const std::uint32_t a = 2 * i, b = a + 1;
        const bool last = i + 1 == kSteps;  // half a turn on, the sides have changed places
        const std::uint32_t c = last ? 1 : a + 2, d = last ? 0 : a + 3;
        for (const std::uint32_t index : {a, c, b, b, c, d}) indices.push_back(index);
    }
    const Topology topology = topology_of(mesh_of(positions, indices));
    EXPECT_EQ(topology.non_manifold_edges, 1U);
    EXPECT_EQ(topology.boundary_edges, 2 * kSteps);
    EXPECT_EQ(topology.components, 1U);
    EXPECT_FALSE(topology.closed);
}

TEST(Topology, CountsAFaceThatStandsTwiceAsNonManifold) {
    const Topology topology = topology_of(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(topology.non_manifold_edges, 3U);
    EXPECT_FALSE(topology.closed);
}

TEST(Topology, DropsFacesWithRepeatedVerticesButKeepsSlivers) {
    Mesh repeated = cube();
    for (const std::uint32_t index : {0U, 0U, 1U}) repeated.indices.push_back(index);
    Topology topology = topology_of(repeated);
    EXPECT_EQ(topology.degenerate_faces, 1U);
    EXPECT_TRUE(topology.closed) << "the repeated face is not part of the surface";

    // A quad beside two triangles that meet in the middle of its edge: the sliver closes the gap.
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {1, -1, 0}};
    topology = topology_of(mesh_of(positions, {0, 2, 3, 0, 3, 4, 5, 1, 0, 5, 2, 1, 0, 1, 2}));
    EXPECT_EQ(topology.degenerate_faces, 1U);
    EXPECT_EQ(topology.boundary_edges, 5U);
    EXPECT_EQ(topology.non_manifold_edges, 0U);
}

Mesh turned_inside_out(Mesh mesh) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) std::swap(mesh.indices[i], mesh.indices[i + 1]);
    return mesh;
}

TEST(Topology, TellsOutwardFromInwardWinding) {
    const bool outward = topology_of(cube()).outward;
    const bool inward = topology_of(turned_inside_out(cube())).outward;
    EXPECT_TRUE(outward);
    EXPECT_FALSE(inward);
    EXPECT_TRUE(topology_of(turned_inside_out(cube())).closed);
}

TEST(Topology, CallsAMeshOutwardOnlyIfEveryComponentIs) {
    EXPECT_TRUE(topology_of(joined(cube(), cube(), {3, 0, 0})).outward);
    EXPECT_FALSE(topology_of(joined(cube(), turned_inside_out(cube()), {3, 0, 0})).outward);
}

TEST(Topology, TellsWindingFarFromTheOriginOfTheModel) {
    Mesh far_off = joined(Mesh{}, cube(), {1e6f, -1e6f, 1e6f});
    EXPECT_TRUE(topology_of(far_off).outward);
    EXPECT_FALSE(topology_of(turned_inside_out(far_off)).outward);
}

TEST(Topology, CallsNothingOutwardThatEnclosesNothing) {
    const std::vector<glm::vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const Topology two_sides = topology_of(mesh_of(corners, {0, 1, 2, 0, 2, 1}));
    EXPECT_TRUE(two_sides.closed);
    EXPECT_FALSE(two_sides.outward);
    Mesh open = cube();
    open.indices.resize(open.indices.size() - 3);
    EXPECT_FALSE(topology_of(open).outward);
    EXPECT_FALSE(topology_of(Mesh{}).outward);
}

TEST(Topology, AnswersForNothing) {
    for (const Mesh& mesh : {Mesh{}, mesh_of({{0, 0, 0}}, {}), mesh_of({{0, 0, 0}}, {0, 0, 0})}) {
        const Topology topology = topology_of(mesh);
        EXPECT_FALSE(topology.closed);
        EXPECT_EQ(topology.boundary_edges, 0U);
        EXPECT_EQ(topology.components, 0U);
        EXPECT_EQ(topology.degenerate_faces, mesh.indices.size() / 3);
    }
}

/// Counts open and non-manifold edges independently: by how many faces use an edge in each direction.
Topology brute_force(const Mesh& mesh) {
    Topology topology;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> uses;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = mesh.indices[i + c], b = mesh.indices[i + (c + 1) % 3];
            ++uses[{std::min(a, b), std::max(a, b)}][a < b ? 0 : 1];
        }
    }
    for (const auto& [edge, count] : uses) {
        if (count[0] + count[1] == 1)
            ++topology.boundary_edges;
        else if (count[0] != 1 || count[1] != 1)
            ++topology.non_manifold_edges;
    }
    return topology;
}

TEST(Topology, AgreesWithCountingEdgesOnRandomFaces) {
    std::mt19937 generator(7);
    const auto random = [&] { return static_cast<std::uint32_t>(generator()); };
    for (int round = 0; round < 300; ++round) {
        const std::uint32_t vertices = 4 + random() % 8;
        Mesh mesh;
        for (std::uint32_t v = 0; v < vertices; ++v) {
            mesh.vertices.push_back({{static_cast<float>(v), static_cast<float>(v * v), 1.0F}, {}, {}});
        }
        const std::uint32_t faces = 1 + random() % 20;
        while (mesh.indices.size() < 3 * faces) {
            const std::uint32_t a = random() % vertices, b = random() % vertices, c = random() % vertices;
            if (a == b || b == c || c == a) continue;
            for (const std::uint32_t index : {a, b, c}) mesh.indices.push_back(index);
        }
        const Topology expected = brute_force(mesh);
        const Topology topology = topology_of(mesh);
        ASSERT_EQ(topology.boundary_edges, expected.boundary_edges) << "round " << round;
        ASSERT_EQ(topology.non_manifold_edges, expected.non_manifold_edges) << "round " << round;
    }
}

TEST(Topology, TakesLinearTimeAroundAVertexOfManyFaces) {
    constexpr std::uint32_t kFaces = 300'000;  // quadratic work would be 1e11 steps
    Mesh mesh;
    mesh.vertices.push_back({{0, 0, 0}, {}, {}});
    for (std::uint32_t i = 0; i <= kFaces; ++i) {
        mesh.vertices.push_back({{1.0F, static_cast<float>(i), static_cast<float>(i % 3)}, {}, {}});
        if (i > 0) mesh.indices.insert(mesh.indices.end(), {0, i, i + 1});
    }
    const auto start = std::chrono::steady_clock::now();
    const Topology topology = topology_of(mesh);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(topology.boundary_edges, kFaces + 2);
    EXPECT_LT(seconds.count(), 20.0);
}

TEST(Normals, WeighFacesByTheirAngle) {
    // At corner 0 of the cube, the face z = 0 has two triangles of 45 degrees, the two others likewise.
    Mesh mesh = cube();
    fill_normals(mesh, std::vector<bool>(mesh.vertices.size(), true));
    for (const assets::Vertex& vertex : mesh.vertices) {
        const glm::vec3 expected = glm::normalize(vertex.position_ms - glm::vec3(0.5F));
        EXPECT_NEAR(glm::distance(vertex.normal_ms, expected), 0.0F, 1e-6F);
    }
}

TEST(Normals, StayZeroWhereAllFacesAreDegenerate) {
    Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 9, 9}}, {0, 1, 2});
    fill_normals(mesh, std::vector<bool>(4, true));
    for (const assets::Vertex& vertex : mesh.vertices) EXPECT_EQ(vertex.normal_ms, glm::vec3(0));
}

TEST(Normals, StayZeroWhereFacesCancel) {
    Mesh mesh = mesh_of({{0.1F, 0.7F, 0.3F}, {1.3F, 0, 0.2F}, {0, 1.1F, 0.9F}}, {0, 1, 2, 2, 1, 0});
    fill_normals(mesh, std::vector<bool>(3, true));
    for (const assets::Vertex& vertex : mesh.vertices) EXPECT_EQ(vertex.normal_ms, glm::vec3(0));
}

TEST(Normals, LeaveVerticesAloneThatAreNotFlagged) {
    Mesh mesh = cube();
    mesh.vertices[3].normal_ms = {1, 0, 0};
    std::vector<bool> missing(mesh.vertices.size(), true);
    missing[3] = false;
    fill_normals(mesh, missing);
    EXPECT_EQ(mesh.vertices[3].normal_ms, glm::vec3(1, 0, 0));
}

TEST(Normals, SurviveVeryUnevenTriangles) {
    Mesh mesh = mesh_of({{0, 0, 0}, {1e6F, 0, 0}, {1e6F, 1e-3F, 0}}, {0, 1, 2});
    fill_normals(mesh, std::vector<bool>(3, true));
    for (const assets::Vertex& vertex : mesh.vertices) EXPECT_EQ(vertex.normal_ms, glm::vec3(0, 0, 1));
}

}  // namespace
}  // namespace gnomon::test
