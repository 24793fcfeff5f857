// A file that is refused changes nothing: neither the world that is being shown, nor what the next file becomes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "engine/gl/device_recording.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/frame_system.h"
#include "systems/lighting/kept_visibility.h"
#include "tests/unit/assets/bad_input.h"

namespace gnomon::test {
namespace {

bool same_meshes(const std::vector<assets::Mesh>& a, const std::vector<assets::Mesh>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const assets::Mesh& m, const assets::Mesh& n) {
        return m.name == n.name && m.vertices == n.vertices && m.indices == n.indices &&
               m.submeshes.size() == n.submeshes.size() && m.bounds_ms.min == n.bounds_ms.min &&
               m.bounds_ms.max == n.bounds_ms.max;
    });
}

std::ptrdiff_t open_files() {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
}

/// A world that is shown, and the way by which an application would replace it.
class ShownWorld : public testing::Test {
protected:
    void SetUp() override { ASSERT_TRUE(replace_by(triangle().gltf(), "good.gltf")); }

    bool replace_by(const Bytes& bytes, const std::string& name) {
        auto scene = load(bytes, name);
        if (!scene) return false;
        frame_.reset();
        world_ = ecs::Registry();
        game::spawn_scene(std::move(scene).value(), world_, library_);
        auto made = FrameSystem::create(device_, library_);
        if (!made) return false;
        frame_ = std::move(made).value();
        return true;
    }

    void step() { frame_->run(world_, {.viewport_px = {96, 54}, .exposure_ev = 10.0F}); }

    gl::RecordingDevice device_;
    ecs::Registry world_;
    assets::MeshLibrary library_;
    std::unique_ptr<FrameSystem> frame_;
};

TEST_F(ShownWorld, StaysAsItIsWhenAnyBadFileIsRefused) {
    // The maps are drawn, and what pixels saw is kept: from now on one frame is like the next.
    for (std::uint32_t i = 0; i < 2 + lighting::KeptVisibility::kStaticFrames; ++i) step();
    const std::uint64_t version = frame_->snapshot().version;
    const gl::CommandList commands = frame_->commands();
    const assets::MeshLibrary library = library_;
    const std::ptrdiff_t files = open_files();
    const auto folder = std::filesystem::current_path();
    for (const BadInput& input : all_bad_inputs()) {
        ASSERT_FALSE(replace_by(input.make(), input.file)) << input.name;
        step();
        ASSERT_EQ(frame_->snapshot().version, version) << input.name;
        ASSERT_EQ(frame_->commands(), commands) << input.name;
        ASSERT_TRUE(same_meshes(library_.meshes, library.meshes)) << input.name;
        ASSERT_EQ(library_.materials.size(), library.materials.size()) << input.name;
        ASSERT_EQ(library_.textures.size(), library.textures.size()) << input.name;
        ASSERT_EQ(open_files(), files) << input.name;
    }
    EXPECT_EQ(std::filesystem::current_path(), folder);
}

TEST_F(ShownWorld, IsReplacedByAGoodFileSoThatTheComparisonCanFail) {
    step();
    step();
    const gl::CommandList commands = frame_->commands();
    const assets::MeshLibrary library = library_;
    GltfBuilder other = triangle();
    other.doc["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 1}}});
    other.doc["meshes"][0]["name"] = "other";
    ASSERT_TRUE(replace_by(other.gltf(), "other.gltf"));
    step();
    step();
    EXPECT_NE(frame_->commands(), commands);
    EXPECT_FALSE(same_meshes(library_.meshes, library.meshes));
}

TEST(BadFiles, LeaveNothingBehindThatChangesTheNextFile) {
    const auto before = load(triangle().gltf());
    for (const BadInput& input : all_bad_inputs()) EXPECT_FALSE(load(input.make(), input.file)) << input.name;
    const auto after = load(triangle().gltf());
    ASSERT_TRUE(before && after);
    EXPECT_TRUE(same_meshes(before.value().meshes, after.value().meshes));
    EXPECT_EQ(before.value().warnings, after.value().warnings);
    EXPECT_EQ(before.value().nodes.size(), after.value().nodes.size());
}

}  // namespace
}  // namespace gnomon::test
