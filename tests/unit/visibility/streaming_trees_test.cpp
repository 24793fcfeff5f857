#include <gmock/gmock.h>

#include "tests/unit/visibility/query_scene.h"

/// Trees of meshes that come to the library, are replaced, and go.
namespace gnomon::visibility {
namespace {

using test::QueryScene;

class StreamingTrees : public ::testing::Test {
protected:
    StreamingTrees() : trees(scene.library), queries(trees) {
        cube = scene.add_cube();
        scene.place(cube, {0.0, 1.0, 0.0});
        scene.finish();
        sun = scene.sun({0.0, 1.0, 0.0});
    }
    float ask(const glm::dvec3& at_ws_m) {
        float answer = -1.0f;
        const Place place{at_ws_m};
        queries.ask(scene.snapshot, sun, std::span(&place, 1), {}, std::span(&answer, 1));
        return answer;
    }
    assets::Mesh moved_cube(const glm::vec3& by_m) const {
        assets::Mesh mesh = scene.library.meshes[cube];
        for (assets::Vertex& vertex : mesh.vertices) vertex.position_ms += by_m;
        return mesh;
    }
    QueryScene scene;
    std::uint32_t cube = 0;
    LightItem sun;
    CasterTrees trees;
    LightQueries queries;
};

TEST_F(StreamingTrees, AreBuiltForNewMeshesAlone) {
    for (int i = 0; i < 3; ++i) scene.place(scene.library.add(moved_cube({})), {10.0 * i, 1.0, 0.0});
    scene.finish();
    EXPECT_EQ(ask({0.0, 0.0, 0.0}), 0.0f);
    EXPECT_EQ(trees.counts().builds, 4u);
    scene.place(scene.library.add(moved_cube({})), {0.0, 1.0, 10.0});
    scene.finish();
    EXPECT_EQ(ask({0.0, 0.0, 10.0}), 0.0f);
    EXPECT_EQ(trees.counts().builds, 1u);
    EXPECT_EQ(trees.counts().trees, 5u);
}

TEST_F(StreamingTrees, AnotherMeshInTheSlotIsNotTakenForTheOldOne) {
    EXPECT_EQ(ask({0.0, 0.0, 0.0}), 0.0f);
    EXPECT_EQ(ask({5.0, 0.0, 0.0}), 1.0f);
    scene.library.replace(cube, moved_cube({5.0f, 0.0f, 0.0f}));
    scene.finish();
    EXPECT_EQ(ask({0.0, 0.0, 0.0}), 1.0f);
    EXPECT_EQ(ask({5.0, 0.0, 0.0}), 0.0f);
    EXPECT_EQ(trees.counts().builds, 1u);
    EXPECT_EQ(trees.counts().trees, 1u);
}

TEST_F(StreamingTrees, AnOlderSnapshotIsNotGivenTheNewMesh) {
    EXPECT_EQ(ask({0.0, 0.0, 0.0}), 0.0f);
    scene.library.replace(cube, moved_cube({5.0f, 0.0f, 0.0f}));
    EXPECT_EQ(ask({5.0, 0.0, 0.0}), 1.0f);
    scene.finish();
    EXPECT_EQ(ask({5.0, 0.0, 0.0}), 0.0f);
}

TEST_F(StreamingTrees, OfRemovedMeshesAreFreed) {
    const std::uint32_t other = scene.library.add(moved_cube({}));
    scene.place(other, {5.0, 1.0, 0.0});
    scene.finish();
    EXPECT_EQ(ask({5.0, 0.0, 0.0}), 0.0f);
    const CasterTrees::Counts both = trees.counts();
    scene.library.remove(other);
    std::erase_if(scene.snapshot.instances, [&](const InstanceItem& item) { return item.mesh == other; });
    scene.finish();
    EXPECT_EQ(ask({5.0, 0.0, 0.0}), 1.0f);
    EXPECT_EQ(ask({0.0, 0.0, 0.0}), 0.0f);
    EXPECT_EQ(trees.tree(other), nullptr);
    EXPECT_EQ(trees.counts().trees, 1u);
    EXPECT_LT(trees.counts().bytes, both.bytes);
    EXPECT_EQ(trees.counts().builds, 0u);
}

}  // namespace
}  // namespace gnomon::visibility
