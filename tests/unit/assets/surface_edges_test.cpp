#include "engine/mesh/surface_edges.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/unit/assets/cube_mesh.h"

namespace gnomon::test {
namespace {

using assets::kCorners;
using assets::kCubeFaces;
using assets::Mesh;
using assets::mesh_of;
using assets::SurfaceEdges;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

SurfaceEdges edges_of(const Mesh& mesh, std::vector<bool> included = {}) {
    included.resize(mesh.indices.size() / 3, included.empty());
    return assets::surface_edges(mesh.vertices, mesh.indices, included);
}

/// Returns both ends of an edge, the smaller first.
template <class Edge>
std::array<std::uint32_t, 2> ends(const Edge& edge) {
    return {std::min(edge.a, edge.b), std::max(edge.a, edge.b)};
}

std::vector<std::array<std::uint32_t, 2>> borders_of(const SurfaceEdges& edges) {
    std::vector<std::array<std::uint32_t, 2>> all;
    for (const auto& border : edges.borders) all.push_back(ends(border));
    return all;
}

/// Two triangles over the edge 0-1.
const std::vector<glm::vec3> kTwo = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};

TEST(SurfaceEdges, OfACubeAreAllFolds) {
    const SurfaceEdges edges = edges_of(mesh_of(kCorners, kCubeFaces));
    EXPECT_THAT(edges.borders, IsEmpty());
    EXPECT_THAT(edges.folds, SizeIs(18));  // Euler: 8 corners + 12 triangles - 2
    for (const auto& fold : edges.folds) EXPECT_FALSE(fold.same_way);
}

TEST(SurfaceEdges, JoinVerticesOfOnePlaceZerosOfEitherSignToo) {
    const Mesh mesh =
        mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -0.0f, 0}, {-0.0f, 0, -0.0f}, {0, -1, 0}}, {0, 1, 2, 3, 4, 5});
    const SurfaceEdges edges = edges_of(mesh);
    EXPECT_THAT(edges.folds, SizeIs(1));
    EXPECT_THAT(edges.borders, SizeIs(4));
}

TEST(SurfaceEdges, SayWhichTrianglesLieBesideAFold) {
    const SurfaceEdges edges = edges_of(mesh_of(kTwo, {0, 1, 2, 1, 0, 3}));
    EXPECT_THAT(edges.folds, ElementsAre(SurfaceEdges::Fold{0, 1, 0, 1, false}));
    EXPECT_THAT(borders_of(edges),
                UnorderedElementsAre(std::array{0u, 2u}, std::array{1u, 2u}, std::array{0u, 3u}, std::array{1u, 3u}));
}

TEST(SurfaceEdges, SayWhereTwoTrianglesAreWoundTheOtherWayRound) {
    const SurfaceEdges edges = edges_of(mesh_of(kTwo, {0, 1, 2, 0, 1, 3}));
    EXPECT_THAT(edges.folds, ElementsAre(SurfaceEdges::Fold{0, 1, 0, 1, true}));
    EXPECT_THAT(edges.borders, SizeIs(4));
}

TEST(SurfaceEdges, EndWhereMoreThanTwoTrianglesMeetHoweverTheyAreWound) {
    for (const std::vector<std::uint32_t>& third : {std::vector<std::uint32_t>{0, 1, 4}, {1, 0, 4}}) {
        std::vector<std::uint32_t> indices{0, 1, 2, 1, 0, 3};
        indices.insert(indices.end(), third.begin(), third.end());
        const SurfaceEdges edges = edges_of(mesh_of(kTwo, indices));
        EXPECT_THAT(edges.folds, IsEmpty());
        EXPECT_THAT(borders_of(edges), testing::Contains(std::array{0u, 1u}).Times(1));
        EXPECT_THAT(edges.borders, SizeIs(7));
    }
}

TEST(SurfaceEdges, TellApartSeveralSharedEdgesOfOneVertex) {
    // Two pairs that disagree and three that share an edge, all at vertex 0.
    std::vector<glm::vec3> places = {{0, 0, 0}};
    for (int i = 1; i < 11; ++i) places.emplace_back(float(i), float(i * i), 1.0f);
    const SurfaceEdges edges =
        edges_of(mesh_of(places, {0, 1, 4, 0, 1, 5, 0, 2, 6, 0, 2, 7, 0, 3, 8, 0, 3, 9, 3, 0, 10}));
    EXPECT_THAT(edges.folds, SizeIs(2));
    EXPECT_THAT(borders_of(edges), testing::Contains(std::array{0u, 3u}).Times(1));
}

TEST(SurfaceEdges, ReachAcrossATriangleThatIsALine) {
    const SurfaceEdges edges = edges_of(mesh_of(kTwo, {0, 1, 2, 1, 0, 3, 0, 0, 1}));
    EXPECT_THAT(edges.folds, SizeIs(1));
    EXPECT_THAT(edges.borders, SizeIs(4));
}

TEST(SurfaceEdges, EndAtTrianglesThatAreLeftOut) {
    const SurfaceEdges edges = edges_of(mesh_of(kTwo, {0, 1, 2, 1, 0, 3}), {true, false});
    EXPECT_THAT(edges.folds, IsEmpty());
    EXPECT_THAT(borders_of(edges), UnorderedElementsAre(std::array{0u, 1u}, std::array{1u, 2u}, std::array{0u, 2u}));
}

}  // namespace
}  // namespace gnomon::test
