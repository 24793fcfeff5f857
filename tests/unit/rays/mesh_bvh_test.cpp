#include "engine/rays/mesh_bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/rays/triangle_soup.h"

namespace gnomon::rays {
namespace {

using test::Soup;

const std::vector<assets::Material> kOneMaterial(1);

bool holds(const BvhNode& node, const glm::vec3& point) {
    for (int axis = 0; axis < 3; ++axis)
        if (point[axis] < node.min[axis] || point[axis] > node.max[axis]) return false;
    return true;
}

/// Checks the promises of BvhNode: every slot in one leaf, all below a node in its box, and the order of the walk.
void expect_sound(const MeshBvh& tree, std::size_t triangles) {
    const auto nodes = tree.nodes();
    std::vector<int> met(tree.triangles().size(), 0);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        ASSERT_GT(nodes[n].skip, n);
        ASSERT_LE(nodes[n].skip, nodes.size());
        EXPECT_EQ(nodes[n].leaf != 0, nodes[n].skip == n + 1) << n;
        for (std::size_t below = n; below < nodes[n].skip; ++below) {
            ASSERT_LE(nodes[below].skip, nodes[n].skip);
            for (std::uint32_t s = nodes[below].first_slot(); s < nodes[below].first_slot() + nodes[below].slots();
                 ++s) {
                const BvhTriangle& t = tree.triangles()[s];
                EXPECT_TRUE(holds(nodes[n], t.a) && holds(nodes[n], t.b) && holds(nodes[n], t.c)) << n << " " << s;
                met[s] += below == n ? 1 : 0;
            }
        }
    }
    EXPECT_EQ(met.size(), triangles);
    EXPECT_EQ(std::count(met.begin(), met.end(), 1), static_cast<std::ptrdiff_t>(triangles));
    if (!nodes.empty()) {
        EXPECT_EQ(nodes[0].skip, nodes.size());
    }
}

TEST(MeshBvh, HoldsEveryTriangleOnceInBoxesThatHoldIt) {
    for (int kind = 0; kind < static_cast<int>(Soup::count); ++kind)
        for (const std::size_t triangles : {1u, 2u, 5u, 300u}) {
            SCOPED_TRACE(std::to_string(kind) + " of " + std::to_string(triangles));
            std::mt19937_64 random(7);
            const assets::Mesh mesh = test::soup(static_cast<Soup>(kind), triangles, 10.0, random);
            expect_sound(MeshBvh(mesh, mesh.vertices, kOneMaterial), mesh.indices.size() / 3);
        }
}

TEST(MeshBvh, OfNothingHasNoNodeAndNoBox) {
    const MeshBvh tree(assets::Mesh{}, {}, kOneMaterial);
    EXPECT_TRUE(tree.nodes().empty());
    EXPECT_TRUE(is_empty(tree.box()));
    EXPECT_EQ(tree.bytes(), 0u);
}

TEST(MeshBvh, OfEqualTrianglesIsNoDeeperThanHalvingThem) {
    assets::Mesh mesh;
    mesh.vertices = {{{0, 0, 0}, {}, {}}, {{1, 0, 0}, {}, {}}, {{0, 1, 0}, {}, {}}};
    for (int i = 0; i < 1000; ++i) mesh.indices.insert(mesh.indices.end(), {0, 1, 2});
    mesh.submeshes = {{0, 3000, 0}};
    const MeshBvh tree(mesh, mesh.vertices, kOneMaterial);
    expect_sound(tree, 1000);
    EXPECT_LT(tree.nodes().size(), 1024u);
}

TEST(MeshBvh, LeavesOutWhatIsNotFiniteAndWhatIsBlended) {
    std::mt19937_64 random(11);
    assets::Mesh mesh = test::soup(Soup::loose, 60, 1.0, random);
    mesh.submeshes = {{0, 90, 0}, {90, 60, 1}, {150, 30, 2}};
    std::vector<assets::Material> materials(3);
    materials[1].alpha_mode = assets::AlphaMode::blend;
    materials[2].alpha_mode = assets::AlphaMode::mask;
    mesh.vertices[mesh.indices[3]].position_ms.y = std::numeric_limits<float>::quiet_NaN();
    mesh.vertices[mesh.indices[7]].position_ms.x = std::numeric_limits<float>::infinity();
    const MeshBvh tree(mesh, mesh.vertices, materials);
    expect_sound(tree, 38);
    const auto masked = [](const BvhTriangle& t) { return t.mask == 2; };
    EXPECT_EQ(std::count_if(tree.triangles().begin(), tree.triangles().end(), masked), 10);
}

TEST(MeshBvh, RefitsWhereVerticesMoveAndBuildsAnewOnceWalksAreHalfAsLongAgain) {
    std::mt19937_64 random(13);
    assets::Mesh mesh = test::soup(Soup::closed_sheet, 2000, 1.0, random);
    mesh.deformer = std::make_shared<assets::Deformer>();
    MeshBvh tree(mesh, mesh.vertices, kOneMaterial);
    std::vector<assets::Vertex> moved = mesh.vertices;
    for (assets::Vertex& v : moved) v.position_ms.y += 0.3f * v.position_ms.x;
    tree.move(mesh, moved);
    expect_sound(tree, mesh.indices.size() / 3);
    EXPECT_EQ(tree.builds(), 1u);
    std::shuffle(moved.begin(), moved.end(), random);
    tree.move(mesh, moved);
    expect_sound(tree, mesh.indices.size() / 3);
    EXPECT_EQ(tree.builds(), 2u);
}

TEST(MeshBvh, OfABentMeshForgivesVerticesThatAreNotFiniteForAWhile) {
    std::mt19937_64 random(17);
    assets::Mesh mesh = test::soup(Soup::loose, 50, 1.0, random);
    mesh.deformer = std::make_shared<assets::Deformer>();
    std::vector<assets::Vertex> torn = mesh.vertices;
    for (std::size_t i = 0; i < 20; ++i) torn[i].position_ms.z = std::numeric_limits<float>::quiet_NaN();
    MeshBvh tree(mesh, torn, kOneMaterial);
    EXPECT_EQ(tree.triangles().size(), 50u);
    tree.move(mesh, mesh.vertices);
    expect_sound(tree, 50);
}

TEST(MeshBvh, IsTheSameForTheSameTriangles) {
    std::mt19937_64 random(19);
    const assets::Mesh mesh = test::soup(Soup::loose, 5000, 1.0, random);
    const MeshBvh one(mesh, mesh.vertices, kOneMaterial), other(mesh, mesh.vertices, kOneMaterial);
    ASSERT_EQ(one.nodes().size(), other.nodes().size());
    EXPECT_TRUE(std::equal(one.triangles().begin(), one.triangles().end(), other.triangles().begin(),
                           [](const BvhTriangle& a, const BvhTriangle& b) { return a.triangle == b.triangle; }));
}

}  // namespace
}  // namespace gnomon::rays
