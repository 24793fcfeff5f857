// Draws every file of the test data as a small picture. All its values are finite. What it shows is recorded, so that a
// file that silently shows nothing stands out.
#include <gtest/gtest.h>

#include <cstdlib>

#include "gnomon/assets.h"
#include "sample_game/support/scene/node_motion.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/frame_system.h"
#include "tests/data/data_files.h"
#include "tests/gl/gl_test_context.h"

namespace gnomon::test {
namespace {

constexpr glm::uvec2 kSize_px{96, 54};
constexpr std::size_t kPixels = std::size_t{kSize_px.x} * kSize_px.y;

/// The textures of the first pass of the group "exposure", which reads what the lights have left.
struct LitTextures {
    gl::TextureHandle depth{}, light{};
};

LitTextures lit_textures(const gl::CommandList& list) {
    LitTextures found;
    bool in_group = false;
    for (const gl::Command& command : list.commands) {
        if (const auto* group = std::get_if<gl::BeginGroup>(&command)) in_group = group->label == "exposure";
        const auto* bind = std::get_if<gl::BindTexture>(&command);
        if (!in_group || bind == nullptr) continue;
        if (bind->unit == 0 && !found.depth) found.depth = bind->texture;
        if (bind->unit == 1 && !found.light) found.light = bind->texture;
    }
    return found;
}

/// Infinities and NaN have all bits of a half's exponent set.
bool is_finite_half(std::uint16_t half) { return (half & 0x7C00U) != 0x7C00U; }

class DataFolderPicture : public GlTest {
protected:
    /// Draws a scene and returns the verdict on its picture, or an error's rule. Fails the test if the picture is
    /// invalid.
    std::string verdict_of(assets::SceneData scene, const std::string& name) {
        ecs::Registry world;
        assets::MeshLibrary library;
        const game::SpawnedScene spawned = game::spawn_scene(std::move(scene), world, library);
        auto made = FrameSystem::create(device(), library);
        if (!made) return made.error().rule;
        const std::unique_ptr<FrameSystem> frame = std::move(made).value();
        game::set_time(spawned, 0.0, world);
        frame->run(world, {.viewport_px = kSize_px, .exposure_ev = {}});
        EXPECT_STREQ(gl::to_text(frame->report().failure), "none") << name;
        std::vector<std::uint8_t> rgba;
        EXPECT_TRUE(frame->read_picture(rgba)) << name;
        EXPECT_EQ(rgba.size(), 4 * kPixels) << name;
        check_visibility(*frame, name);
        const bool seen = shows_surface(*frame, name);
        const bool places_any =
            std::any_of(frame->snapshot().instances.begin(), frame->snapshot().instances.end(),
                        [&](const auto& i) { return i.visible && !library.meshes[i.mesh].indices.empty(); });
        EXPECT_TRUE(places_any || !seen) << name << " shows a surface that it does not have";
        return seen ? kSeen : places_any ? kOutOfView : kNothing;
    }

private:
    bool shows_surface(FrameSystem& frame, const std::string& name) {
        const LitTextures lit = lit_textures(frame.commands());
        const auto depth = read<float>(lit.depth, kPixels);
        const auto light = read<std::uint16_t>(lit.light, 4 * kPixels);
        EXPECT_TRUE(std::all_of(depth.begin(), depth.end(), [](float d) { return d >= 0.0F && d <= 1.0F; })) << name;
        EXPECT_TRUE(std::all_of(light.begin(), light.end(), is_finite_half)) << name << ": light is not finite";
        bool seen = std::any_of(depth.begin(), depth.end(), [](float d) { return d > 0.0F; });
        for (std::size_t i = 0; i < kPixels; ++i)  // blended surfaces leave no depth
            for (std::size_t c = 0; c < 3; ++c) seen |= (light[4 * i + c] & 0x7FFFU) != 0;
        return seen;
    }

    static void check_visibility(FrameSystem& frame, const std::string& name) {
        std::vector<float> values;
        for (std::uint32_t light = 0; light < frame.snapshot().lights.size(); ++light) {
            if (!frame.read_visibility(light, values)) continue;
            EXPECT_TRUE(std::all_of(values.begin(), values.end(),
                                    [](float v) { return v == -1.0F || (v >= 0.0F && v <= 1.0F); }))
                << name << ", light " << light;
        }
    }
};

TEST_F(DataFolderPicture, EveryFileEndsInItsRecordedPictureOrRule) {
    const std::vector<std::string> files = data_files();
    if (files.empty()) GTEST_SKIP() << "no test data at " << data_folder();
    Watchdog watchdog;
    Verdicts verdicts;
    for (const std::string& name : files) {
        watchdog.watch(name);
        auto scene = assets::load_gltf(data_folder() / name);
        verdicts[name] = scene ? verdict_of(std::move(scene).value(), name) : scene.error().rule;
        EXPECT_EQ(gl::live_objects(device()), 0U) << name << " leaves objects";
        for (const std::string& message : take_messages()) ADD_FAILURE() << name << ": OpenGL says: " << message;
    }
    if (std::getenv("GNOMON_RECORD_VERDICTS") != nullptr) record_verdicts(verdicts);
    EXPECT_EQ(verdicts, recorded_verdicts());
}

}  // namespace
}  // namespace gnomon::test
