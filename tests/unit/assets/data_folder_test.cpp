// Real files that others wrote, many of them wrong on purpose: each has its recorded verdict.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>

#include "gnomon/assets.h"
#include "tests/data/data_files.h"

namespace gnomon::test {
namespace {

void check_invariants(const assets::SceneData& scene, const std::string& name) {
    EXPECT_FALSE(scene.materials.empty()) << name;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const auto& node = scene.nodes[i];
        EXPECT_LT(node.parent, static_cast<std::int32_t>(i)) << name;
        EXPECT_LT(node.mesh, static_cast<std::int32_t>(scene.meshes.size())) << name;
        EXPECT_LT(node.light, static_cast<std::int32_t>(scene.lights.size())) << name;
        EXPECT_LT(node.camera, static_cast<std::int32_t>(scene.cameras.size())) << name;
    }
    for (const auto& mesh : scene.meshes) {
        std::size_t next = 0;
        for (const auto& submesh : mesh.submeshes) {
            EXPECT_EQ(submesh.first_index, next) << name;
            EXPECT_LT(submesh.material, scene.materials.size()) << name;
            next += submesh.index_count;
        }
        EXPECT_EQ(next, mesh.indices.size()) << name;
        EXPECT_EQ(mesh.indices.size() % 3, 0U) << name;
        const bool in_range = std::all_of(mesh.indices.begin(), mesh.indices.end(),
                                          [&](std::uint32_t index) { return index < mesh.vertices.size(); });
        EXPECT_TRUE(in_range) << name;
    }
    for (const auto& material : scene.materials) {
        EXPECT_LT(material.base_colour_texture, static_cast<std::int32_t>(scene.textures.size())) << name;
    }
    for (const auto& texture : scene.textures) {
        EXPECT_EQ(texture.rgba.size(), std::size_t{texture.width} * texture.height * 4) << name;
    }
}

TEST(DataFolder, EveryFileLoadsOrEndsInItsRecordedRule) {
    const std::vector<std::string> files = data_files();
    if (files.empty()) GTEST_SKIP() << "no test data at " << data_folder();
    Watchdog watchdog;
    Verdicts loaded, expected = recorded_verdicts();
    for (auto& [name, verdict] : expected)
        if (is_picture(verdict)) verdict = "loads";
    for (const std::string& name : files) {
        watchdog.watch(name);
        const auto result = assets::load_gltf(data_folder() / name);
        loaded[name] = result ? "loads" : result.error().rule;
        if (result) {
            check_invariants(result.value(), name);
        } else {
            const std::string line = to_line(result.error());
            EXPECT_EQ(line.find('\n'), std::string::npos) << line;
            EXPECT_THAT(line, testing::StartsWith((data_folder() / name).string()));
        }
    }
    EXPECT_EQ(loaded, expected);
}

TEST(DataFolder, SponzaLoadsWithItsTopologyWellWithinItsBudget) {
    const std::filesystem::path sponza = data_folder() / "sponza-crytek/Sponza.gltf";
    if (!std::filesystem::exists(sponza)) GTEST_SKIP() << "no " << sponza;
    const auto start = std::chrono::steady_clock::now();
    const auto result = assets::load_gltf(sponza);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    ASSERT_TRUE(result) << to_line(result.error());
    std::size_t triangles = 0;
    for (const auto& mesh : result.value().meshes) triangles += mesh.indices.size() / 3;
    EXPECT_EQ(triangles, 262'267U);
    EXPECT_EQ(result.value().textures.size(), 3U);
    EXPECT_THAT(result.value().warnings, testing::IsEmpty());
    // A tenth of a second in a release build; the limit leaves room for sanitizers and a busy machine.
    EXPECT_LT(seconds.count(), 10.0);
    RecordProperty("seconds", std::to_string(seconds.count()));
}

}  // namespace
}  // namespace gnomon::test
