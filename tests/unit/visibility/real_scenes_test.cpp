#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <random>

#include "tests/source_paths.h"
#include "tests/unit/visibility/loaded_scene.h"
#include "tests/unit/visibility/query_scene.h"

/// Visibility queries on scenes that others made, against the reference's double.
namespace gnomon::visibility {
namespace {

const std::filesystem::path kSponza = "sponza-crytek/Sponza.gltf", kFox = "fox-draco-testdata/Fox/glTF/Fox.gltf";

/// A loaded scene, queries about it, and the answers against the reference.
struct AskedScene : test::LoadedScene {
    using LoadedScene::LoadedScene;

    /// Returns a sun, a lamp with a range and a spot; each reaches a good part of the scene.
    std::vector<LightItem> lights() const {
        const math::Aabb box = bounds();
        const glm::dvec3 size = box.max - box.min;
        LightItem sun, lamp, spot;
        sun.kind = LightKind::directional;
        sun.rotation_ws = math::basis_from_back({0.25, 1.0, 0.15});
        lamp.position_ws_m = box.min + size * glm::dvec3(0.45, 0.4, 0.52);
        lamp.range_m = 0.6 * glm::length(size);
        spot.kind = LightKind::spot;
        spot.position_ws_m = box.min + size * glm::dvec3(0.2, 0.9, 0.5);
        spot.rotation_ws = math::basis_from_back({-0.5, 0.6, 0.1});
        spot.outer_cone_rad = 0.8;
        return {sun, lamp, spot};
    }
    std::vector<Place> places(std::size_t count, std::uint64_t seed) const {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> share(0.0, 1.0);
        const math::Aabb box = bounds();
        std::vector<Place> places(count);
        for (Place& place : places)
            place.at_ws_m = box.min + (box.max - box.min) * glm::dvec3(share(random), share(random), share(random));
        return places;
    }
    test::Agreement compared(CasterTrees& trees, std::size_t count) {
        const oracle::TracedWorld reference(snapshot, library, math::centre(bounds()));
        const std::vector<Place> asked = places(count, 20240917);
        std::vector<float> answers(count);
        LightQueries queries(trees);
        test::Agreement agreement;
        for (const LightItem& light : lights()) {
            queries.ask(snapshot, light, asked, {}, answers);
            test::compare(reference, light, asked, answers, glm::length(math::half_extent(bounds())), agreement);
        }
        return agreement;
    }
};

std::unique_ptr<AskedScene> load(const std::optional<std::filesystem::path>& name,
                                 const glm::dvec3& offset_m = glm::dvec3(0.0)) {
    std::optional<std::filesystem::path> file;
    if (name) file = test::data_folder() / *name;
    if (file && !std::filesystem::exists(*file)) return nullptr;
    auto scene = game::load_scene(file);
    EXPECT_TRUE(scene) << to_line(scene.error());
    return std::make_unique<AskedScene>(std::move(scene).value(), offset_m);
}

void expect_agreement(const test::Agreement& agreement, std::size_t asked) {
    EXPECT_EQ(agreement.wrong, 0u);
    EXPECT_LE(agreement.ambiguous, asked / 5000);
    EXPECT_GT(agreement.lit, asked / 20);
    EXPECT_GT(agreement.dark, asked / 20);
    ::testing::Test::RecordProperty("ambiguous", static_cast<int>(agreement.ambiguous));
}

TEST(QueriesOfRealScenes, SponzaIsAsTheReferenceHasIt) {
    const auto scene = load(kSponza);
    if (!scene) GTEST_SKIP() << kSponza << " is not there";
    CasterTrees trees(scene->library);
    expect_agreement(scene->compared(trees, 30000), 90000);
    EXPECT_EQ(trees.counts().triangles, 262267u);
    EXPECT_LT(trees.counts().bytes, 80u * 262267u);
}

TEST(QueriesOfRealScenes, SponzaHasTreesAsGoodAsTheHeuristicCanMakeThem) {
    const auto scene = load(kSponza);
    if (!scene) GTEST_SKIP() << kSponza << " is not there";
    assets::Mesh all;
    for (const InstanceItem& item : scene->snapshot.instances) {
        const assets::Mesh& mesh = scene->library.meshes[item.mesh];
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        for (const assets::Vertex& vertex : mesh.vertices)
            all.vertices.push_back({glm::vec3(item.basis * glm::dvec3(vertex.position_ms)), {}, {}});
        for (const std::uint32_t index : mesh.indices) all.indices.push_back(first + index);
    }
    all.submeshes = {{0, static_cast<std::uint32_t>(all.indices.size()), 0}};
    const rays::MeshBvh tree(all, all.vertices, std::vector<assets::Material>(1));
    const rays::BvhCost cost = tree.cost();
    EXPECT_LT(cost.nodes, 60.0);
    EXPECT_LT(cost.triangles, 40.0);
    RecordProperty("nodes", std::to_string(cost.nodes));
    RecordProperty("triangles", std::to_string(cost.triangles));
}

TEST(QueriesOfRealScenes, TheCourtyardIsAsTheReferenceHasItHereAndFarAway) {
    for (const double offset_m : {0.0, 1e8}) {
        const auto scene = load(std::nullopt, {offset_m, -offset_m, 0.5 * offset_m});
        scene->move_to(3.7);
        CasterTrees trees(scene->library);
        expect_agreement(scene->compared(trees, 20000), 60000);
    }
}

TEST(QueriesOfRealScenes, TheFoxDarkensWhereItsBonesHaveTakenIt) {
    const auto scene = load(kFox);
    if (!scene) GTEST_SKIP() << kFox << " is not there";
    ASSERT_EQ(scene->snapshot.poses.size(), 1u);
    CasterTrees trees(scene->library);
    test::Agreement all;
    for (const double time_s : {0.0, 0.35, 0.8}) {
        scene->move_to(time_s);
        const test::Agreement now = scene->compared(trees, 20000);
        EXPECT_EQ(now.wrong, 0u) << time_s;
        EXPECT_EQ(trees.counts().builds + trees.counts().refits, 1u) << time_s;
        all.dark += now.dark;
        all.ambiguous += now.ambiguous;
    }
    EXPECT_GT(all.dark, 5000u);
    EXPECT_LT(all.ambiguous, 100u);
    // Control: without a new version of the pose, the tree stays as it was and is wrong.
    const std::uint64_t version = scene->snapshot.poses[0].version;
    scene->move_to(0.35);
    scene->snapshot.poses[0].version = version;
    EXPECT_GT(scene->compared(trees, 20000).wrong, 20u);
}

}  // namespace
}  // namespace gnomon::visibility
