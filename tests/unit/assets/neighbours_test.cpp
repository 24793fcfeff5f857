#include <gmock/gmock.h>

#include "engine/mesh/mesh_topology.h"
#include "tests/unit/assets/cube_mesh.h"

namespace gnomon::test {
namespace {

using assets::kCorners;
using assets::kCubeFaces;
using assets::kNoNeighbour;
using assets::Mesh;
using assets::mesh_of;
using assets::triangle_neighbours;
using ::testing::Each;
using ::testing::ElementsAre;

glm::vec3 corner(const Mesh& mesh, std::uint32_t triangle, std::uint32_t c) {
    return mesh.vertices[mesh.indices[3 * triangle + c % 3]].position_ms;
}

/// Checks that each edge has a triangle beyond it, with the same two places in reverse order, that names the first
/// triangle in turn.
void expect_mutual(const Mesh& mesh) {
    const std::vector<std::uint32_t> across = triangle_neighbours(mesh);
    ASSERT_EQ(across.size(), mesh.indices.size());
    for (std::uint32_t t = 0; t < across.size() / 3; ++t)
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint32_t other = across[3 * t + c];
            ASSERT_LT(other, across.size() / 3) << "triangle " << t << " edge " << c;
            bool back = false;
            for (std::uint32_t k = 0; k < 3; ++k)
                back = back || (across[3 * other + k] == t && corner(mesh, other, k) == corner(mesh, t, c + 1) &&
                                corner(mesh, other, k + 1) == corner(mesh, t, c));
            EXPECT_TRUE(back) << "triangle " << t << " edge " << c;
        }
}

TEST(TriangleNeighbours, OfACubeAreMutualAcrossEveryEdge) { expect_mutual(mesh_of(kCorners, kCubeFaces)); }

TEST(TriangleNeighbours, AreFoundByPlaceWhereEveryFaceHasItsOwnVertices) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (const std::uint32_t index : kCubeFaces) {
        indices.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.push_back(kCorners[index]);
    }
    expect_mutual(mesh_of(positions, indices));
    positions.front().x += 1.0e-7f;
    EXPECT_THAT(triangle_neighbours(mesh_of(positions, indices)), ::testing::Contains(kNoNeighbour))
        << "one corner a hair off is another place";
}

TEST(TriangleNeighbours, OfAnOpenQuadMeetAtItsDiagonalOnly) {
    const Mesh quad = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3});
    EXPECT_THAT(triangle_neighbours(quad), ElementsAre(kNoNeighbour, kNoNeighbour, 1u, 0u, kNoNeighbour, kNoNeighbour));
}

TEST(TriangleNeighbours, StopAtAnEdgeOfThreeFacesAndAtOneThatIsWoundAgainst) {
    const Mesh fan = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {0, 1, 2, 1, 0, 3, 0, 1, 4});
    EXPECT_THAT(triangle_neighbours(fan), Each(kNoNeighbour));
    const Mesh against = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 3, 2});
    EXPECT_THAT(triangle_neighbours(against), Each(kNoNeighbour));
}

TEST(TriangleNeighbours, CountOnPastATriangleWithTwoCornersInOnePlace) {
    const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 1, 0, 1, 2, 0, 2, 3});
    EXPECT_THAT(triangle_neighbours(mesh), ElementsAre(kNoNeighbour, kNoNeighbour, kNoNeighbour,  //
                                                       kNoNeighbour, kNoNeighbour, 2u,            //
                                                       1u, kNoNeighbour, kNoNeighbour));
}

TEST(TriangleNeighbours, OfNothingAreNone) { EXPECT_TRUE(triangle_neighbours(Mesh{}).empty()); }

}  // namespace
}  // namespace gnomon::test
