#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "bench/pictures/edge_errors.h"
#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/frame_system.h"
#include "tests/gl/gl_test_context.h"
#include "tests/source_paths.h"

/// Smoothed edges beside pictures of 64 samples, in scenes: nearer to them than pictures of one sample, where these
/// differ, and nowhere else much farther.
namespace gnomon {
namespace {

constexpr glm::uvec2 kSize_px{320, 180};
constexpr std::uint32_t kSamples = 64;

class SmoothedEdges : public GlTest {
protected:
    /// Expects the smoothed picture of a scene's first camera to be nearer by `least` to that of 64 samples.
    void judge(const char* name, const std::optional<std::filesystem::path>& file, double least) {
        auto data = game::load_scene(file);
        ASSERT_TRUE(data) << to_line(data.error());
        ecs::Registry world;
        assets::MeshLibrary library;
        const game::SpawnedScene scene = game::spawn_scene(std::move(data).value(), world, library);
        game::set_time(scene, 3.0, world);
        auto made = FrameSystem::create(device(), library);
        ASSERT_TRUE(made) << to_line(made.error());
        const auto pictures =
            bench::draw_edges(*made.value(), world, {.viewport_px = kSize_px, .repeatable = true}, kSamples);
        ASSERT_TRUE(pictures);
        const bench::EdgeErrors e = bench::edge_errors(*pictures);
        std::cout << name << ": " << 100.0 * e.share << " % of pixels differ; mean square there " << e.one
                  << " with one sample, " << e.smooth << " smoothed: " << e.one / e.smooth
                  << " times nearer; everywhere " << e.one_all << " and " << e.smooth_all << "\n";
        EXPECT_GT(e.share, 0.01) << "there are edges";
        EXPECT_GT(e.one, least * e.smooth);
        EXPECT_GT(e.one_all, e.smooth_all);
    }
};

TEST_F(SmoothedEdges, OfTheCourtyardAreNearerToManySamples) { judge("courtyard", {}, 2.5); }

TEST_F(SmoothedEdges, OfTheValleyAreNearerToManySamples) { judge("valley", game::kValleyScene, 2.5); }

TEST_F(SmoothedEdges, OfSponzaAreNearerToManySamples) {
    const std::filesystem::path file = test::data_folder() / "sponza-crytek" / "Sponza.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
    judge("Sponza", file, 2.5);
}

}  // namespace
}  // namespace gnomon
