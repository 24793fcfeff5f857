#include "systems/visibility/instance_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "engine/math/projection.h"
#include "tests/unit/math/random_seed.h"

namespace gnomon::visibility {
namespace {

/// Instances of one mesh, here and there, turned, stretched and mirrored.
struct Scene {
    SceneSnapshot snapshot;
    std::vector<MeshTreePlace> meshes{{.first_node = 5, .nodes = 7, .first_slot = 11, .box = {}, .tree = {}}};
    std::mt19937_64 random;

    Scene(std::size_t count, const glm::dvec3& around_ws_m, std::uint64_t seed) : random(seed) {
        meshes[0].box = {glm::vec3(-1.0f, -0.5f, 0.0f), glm::vec3(2.0f, 0.5f, 3.0f)};
        snapshot.version = snapshot.list_version = 1;
        for (std::uint32_t i = 0; i < count; ++i) {
            InstanceItem item;
            item.gpu_slot = 100 + i;
            item.casts = i % 5 != 4;
            item.cast_layers = static_cast<ShadowLayers>(1u << i % 8);
            snapshot.instances.push_back(item);
            move(i, around_ws_m);
        }
    }
    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
    void move(std::size_t i, const glm::dvec3& around_ws_m) {
        InstanceItem& item = snapshot.instances[i];
        const glm::dquat turn = glm::normalize(glm::dquat(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1)));
        const glm::dvec3 scale(number(0.1, 2.0), number(-2.0, -0.1), number(0.1, 2.0));
        item.basis = glm::mat3_cast(turn) * glm::dmat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
        item.translation_ws_m = around_ws_m + glm::dvec3(number(-50, 50), number(-50, 50), number(-50, 50));
        const math::Aabb box{glm::dvec3(meshes[0].box.min), glm::dvec3(meshes[0].box.max)};
        item.bounds_ws = math::transformed(box, item.basis, item.translation_ws_m);
    }
    void shift(std::size_t i, const glm::dvec3& by_m) {
        snapshot.instances[i].translation_ws_m += by_m;
        snapshot.instances[i].bounds_ws.min += by_m;
        snapshot.instances[i].bounds_ws.max += by_m;
    }
};

/// Places a corner as shaders do: rounded basis, translation in two floats, seen from the anchor.
glm::vec3 placed(const InstanceItem& item, const glm::vec3& corner, const RayTop& top) {
    const math::TwoFloat3 at = math::split(item.translation_ws_m);
    const glm::mat3 basis(item.basis);
    const glm::vec3 offset = (at.high - top.anchor_high) + (at.low - top.anchor_low);
    return basis * corner + offset;
}

bool holds(const rays::BvhNode& node, const glm::vec3& p) {
    return glm::all(glm::lessThanEqual(node.min, p)) && glm::all(glm::lessThanEqual(p, node.max));
}

/// Checks that every caster is in one leaf, and its corners in all boxes above.
void expect_sound(const InstanceTree& tree, const Scene& scene) {
    std::size_t met = 0;
    const auto nodes = tree.nodes();
    for (std::size_t n = 0; n < nodes.size(); ++n)
        for (std::size_t below = n; below < nodes[n].skip; ++below) {
            if (nodes[below].leaf == 0) continue;
            ASSERT_EQ(nodes[below].slots(), 1u);
            const RayInstance& record = tree.parts()[nodes[below].first_slot()];
            const InstanceItem& item = scene.snapshot.instances[record.instance - 100];
            met += below == n ? 1 : 0;
            const rays::Box& box = scene.meshes[0].box;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                  corner & 4 ? box.max.z : box.min.z);
                EXPECT_TRUE(holds(nodes[n], placed(item, p, tree.head()))) << n << " " << below;
            }
        }
    const auto casts = [](const InstanceItem& item) { return item.casts; };
    const auto& all = scene.snapshot.instances;
    EXPECT_EQ(met, static_cast<std::size_t>(std::count_if(all.begin(), all.end(), casts)));
    EXPECT_EQ(tree.parts().size(), met);
    EXPECT_EQ(tree.instances(), met);
    EXPECT_EQ(tree.head().nodes, nodes.size());
}

TEST(InstanceTree, HoldsEveryCasterOnceWhereShadersPlaceItHereAndFarAway) {
    const std::uint64_t seed = print_seed();
    for (const double far_m : {0.0, 1.0e6, 1.0e8})
        for (const std::size_t count : {1u, 2u, 9u, 200u}) {
            SCOPED_TRACE(std::to_string(far_m) + ", " + std::to_string(count));
            Scene scene(count, {far_m, -far_m, 0.3 * far_m}, seed);
            InstanceTree tree;
            tree.update(scene.snapshot, scene.meshes, false);
            expect_sound(tree, scene);
        }
}

TEST(InstanceTree, FollowsWhatMovesAndIsBuiltAnewWhereThatMadeItLoose) {
    Scene scene(60, glm::dvec3(0.0), print_seed());
    InstanceTree tree;
    tree.update(scene.snapshot, scene.meshes, false);
    EXPECT_EQ(tree.builds(), 1u);
    scene.shift(3, {0.01, 0.0, 0.0});
    tree.update(scene.snapshot, scene.meshes, true);
    EXPECT_EQ(tree.builds(), 1u);
    expect_sound(tree, scene);
    for (std::size_t i = 0; i < scene.snapshot.instances.size(); ++i) scene.move(i, {500.0, 0.0, 0.0});
    tree.update(scene.snapshot, scene.meshes, true);
    EXPECT_EQ(tree.builds(), 2u);
    expect_sound(tree, scene);
}

TEST(InstanceTree, SaysWhereAMeshsTreeLiesAndHowItIsTurned) {
    Scene scene(1, glm::dvec3(0.0), print_seed());
    InstanceTree tree;
    tree.update(scene.snapshot, scene.meshes, false);
    const RayInstance& record = tree.parts()[0];
    EXPECT_EQ(record.first_node, 5u);
    EXPECT_EQ(record.begin_node, 0u);
    EXPECT_EQ(record.end_node, 7u);
    EXPECT_EQ(record.first_slot, 11u);
    EXPECT_EQ(record.layers, 1u);
    const glm::dvec3 along(0.3, -0.2, 0.9), image = scene.snapshot.instances[0].basis * along;
    const glm::dvec3 back = glm::dvec3(record.to_model_x) * image.x + glm::dvec3(record.to_model_y) * image.y +
                            glm::dvec3(record.to_model_z) * image.z;
    EXPECT_LT(glm::length(back - along), 1e-5);
}

TEST(InstanceTree, OfABasisWithoutAnInverseMeetsEverything) {
    Scene scene(1, glm::dvec3(0.0), print_seed());
    scene.snapshot.instances[0].basis[1] = glm::dvec3(0.0);
    InstanceTree tree;
    tree.update(scene.snapshot, scene.meshes, false);
    EXPECT_GT(tree.parts()[0].slack_per_m, 1e12f);
    EXPECT_EQ(tree.parts()[0].to_model_x, glm::vec3(0.0f));
}

/// A mesh with a tree of its own, in several instances; one more mesh bends, and is not opened.
struct OpenScene : Scene {
    rays::Bvh tree;
    OpenScene(std::size_t instances, std::size_t triangles, std::uint64_t seed) : Scene(instances, {}, seed) {
        std::vector<rays::Box> boxes;
        for (std::size_t i = 0; i < triangles; ++i) {
            const glm::vec3 at(number(-1, 2), number(-0.5, 0.5), number(0, 3));
            boxes.push_back({at, at});
        }
        tree = rays::build_bvh(boxes);
        const auto nodes = static_cast<std::uint32_t>(tree.nodes.size());
        meshes[0] = {5, nodes, 11, {tree.nodes[0].min, tree.nodes[0].max}, tree.nodes};
        meshes.push_back({5 + nodes, nodes, 11, meshes[0].box, {}});
        snapshot.instances.back().mesh = 1;
        snapshot.instances.back().casts = true;
    }
};

/// Checks that each caster has all leaves of its mesh, once. The boxes of its parts, and all boxes above, contain them.
void expect_whole(const InstanceTree& tree, const OpenScene& scene) {
    std::vector<std::vector<int>> seen(scene.snapshot.instances.size(), std::vector<int>(scene.tree.nodes.size()));
    const auto nodes = tree.nodes();
    for (std::size_t n = 0; n < nodes.size(); ++n)
        for (std::size_t below = n; below < nodes[n].skip; ++below) {
            if (nodes[below].leaf == 0) continue;
            const RayInstance& part = tree.parts()[nodes[below].first_slot()];
            const std::size_t i = part.instance - 100;
            for (std::uint32_t k = part.begin_node; k < part.end_node; ++k) {
                const rays::BvhNode& leaf = scene.tree.nodes[k];
                if (leaf.leaf == 0) continue;
                if (below == n) ++seen[i][k];
                for (const glm::vec3& p : {leaf.min, leaf.max})
                    EXPECT_TRUE(holds(nodes[n], placed(scene.snapshot.instances[i], p, tree.head())));
            }
        }
    for (std::size_t i = 0; i < seen.size(); ++i)
        for (std::size_t k = 0; k < scene.tree.nodes.size(); ++k)
            EXPECT_EQ(seen[i][k], scene.snapshot.instances[i].casts && scene.tree.nodes[k].leaf != 0 ? 1 : 0)
                << i << ' ' << k;
}

TEST(InstanceTree, TakesLargeInstancesApartAndLosesNothingOfThem) {
    const std::uint64_t seed = print_seed();
    for (const std::size_t triangles : {1u, 9u, 400u, 4000u}) {
        SCOPED_TRACE(triangles);
        OpenScene scene(9, triangles, seed);
        InstanceTree tree;
        tree.update(scene.snapshot, scene.meshes, false);
        expect_whole(tree, scene);
        const std::size_t casters = tree.instances();
        EXPECT_EQ(casters, 8u);  // one of nine casts nothing
        EXPECT_LE(tree.parts().size(), casters + InstanceTree::kMostOpened);
        // Opened down to the leaves where there is room for that, except for the caster that bends.
        std::size_t leaves = 0;
        for (const rays::BvhNode& node : scene.tree.nodes) leaves += node.leaf != 0 ? 1 : 0;
        EXPECT_EQ(tree.parts().size(), std::min(casters + InstanceTree::kMostOpened, (casters - 1) * leaves + 1));
        std::size_t of_bent = 0;
        for (const RayInstance& part : tree.parts()) of_bent += part.first_node == scene.meshes[1].first_node ? 1 : 0;
        EXPECT_EQ(of_bent, 1u);
        // An instance that moves takes its parts along. A step of a thousandth of its place loosens no box by much.
        scene.shift(0, {0.05, 0.0, 0.0});
        tree.update(scene.snapshot, scene.meshes, true);
        EXPECT_EQ(tree.builds(), 1u);
        expect_whole(tree, scene);
        // A jump to anywhere, turned and resized, may pass kLooseGrowth or not.
        scene.move(0, {3.0, 0.0, 0.0});
        tree.update(scene.snapshot, scene.meshes, true);
        EXPECT_LE(tree.builds(), 2u);
        expect_whole(tree, scene);
    }
}

TEST(InstanceTree, TakesThoseApartWhosePartsAreLarge) {
    OpenScene scene(3, 40000, print_seed());
    // The second is a thousand times smaller than the others, and the third bends: only the first is opened.
    for (InstanceItem& item : scene.snapshot.instances) item.basis = glm::dmat3(1.0);
    scene.snapshot.instances[1].basis = glm::dmat3(1e-3);
    for (InstanceItem& item : scene.snapshot.instances)
        item.bounds_ws = math::transformed({glm::dvec3(scene.meshes[0].box.min), glm::dvec3(scene.meshes[0].box.max)},
                                           item.basis, item.translation_ws_m);
    InstanceTree tree;
    tree.update(scene.snapshot, scene.meshes, false);
    std::size_t parts[3] = {};
    for (const RayInstance& part : tree.parts()) ++parts[part.instance - 100];
    EXPECT_EQ(parts[0], 1 + InstanceTree::kMostOpened);
    EXPECT_EQ(parts[1], 1u);
    EXPECT_EQ(parts[2], 1u);  // bends
}

TEST(InstanceTree, OfNobodyHasNoNode) {
    Scene scene(0, glm::dvec3(0.0), 1);
    InstanceTree tree;
    tree.update(scene.snapshot, scene.meshes, false);
    EXPECT_EQ(tree.head().nodes, 0u);
    EXPECT_TRUE(tree.nodes().empty());
}

}  // namespace
}  // namespace gnomon::visibility
