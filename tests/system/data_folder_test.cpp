// Every file of the test data from the door to a frame's commands. Under the sanitizers nothing on that way may read or
// write where it should not; without them, nothing may be misused or left behind.
#include <gtest/gtest.h>

#include "engine/gl/device_recording.h"
#include "gnomon/assets.h"
#include "sample_game/support/scene/node_motion.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/frame_system.h"
#include "tests/data/data_files.h"

namespace gnomon::test {
namespace {

std::size_t placed_triangles(const FrameSystem& frame, const assets::MeshLibrary& library) {
    std::size_t triangles = 0;
    for (const InstanceItem& item : frame.snapshot().instances)
        if (item.visible) triangles += library.meshes[item.mesh].indices.size() / 3;
    return triangles;
}

/// Runs two frames, the second one of a moved scene. Returns the number of triangles that the scene places.
std::size_t run_frames(assets::SceneData scene, const std::string& name) {
    constexpr double kLater_s = 0.4;
    ecs::Registry world;
    assets::MeshLibrary library;
    const game::SpawnedScene spawned = game::spawn_scene(std::move(scene), world, library);
    gl::RecordingDevice device;
    std::size_t triangles = 0;
    {
        auto made = FrameSystem::create(device, library);
        if (!made) {
            ADD_FAILURE() << name << ": " << to_line(made.error());
            return 0;
        }
        const std::unique_ptr<FrameSystem> frame = std::move(made).value();
        for (const double time_s : {0.0, kLater_s}) {
            game::set_time(spawned, time_s, world);
            frame->run(world, {.viewport_px = {96, 54}, .exposure_ev = {}});
            EXPECT_STREQ(gl::to_text(frame->report().failure), "none") << name;
            EXPECT_TRUE(frame->picture_target()) << name << " has no picture";
        }
        triangles = placed_triangles(*frame, library);
    }
    device.check_leaks();
    for (const gl::Finding& f : device.findings())
        ADD_FAILURE() << name << ": " << to_text(f.misuse) << ": " << f.detail;
    return triangles;
}

TEST(DataFolderFrame, EveryFileEndsInCommandsThatNothingIsWrongWithOrInItsRecordedRule) {
    const std::vector<std::string> files = data_files();
    if (files.empty()) GTEST_SKIP() << "no test data at " << data_folder();
    const Verdicts recorded = recorded_verdicts();
    EXPECT_EQ(recorded.size(), files.size());
    Watchdog watchdog;
    for (const std::string& name : files) {
        watchdog.watch(name);
        const auto found = recorded.find(name);
        const std::string expected = found == recorded.end() ? "no verdict" : found->second;
        auto scene = assets::load_gltf(data_folder() / name);
        if (!scene) {
            EXPECT_EQ(scene.error().rule, expected) << name;
            continue;
        }
        const std::size_t triangles = run_frames(std::move(scene).value(), name);
        EXPECT_TRUE(is_picture(expected)) << name << " is drawn, recorded is " << expected;
        EXPECT_EQ(triangles == 0, expected == kNothing) << name << " places " << triangles << " triangles";
    }
}

using DataWatchdogDeathTest = testing::Test;

TEST_F(DataWatchdogDeathTest, NamesTheFileThatHangs) {
    const auto hang = [] {
        Watchdog watchdog(0.5);
        watchdog.watch("slow.gltf");
        const volatile bool forever = true;
        while (forever) {
        }
    };
    EXPECT_EXIT(hang(), testing::ExitedWithCode(EXIT_FAILURE), "slow.gltf hangs");
}

}  // namespace
}  // namespace gnomon::test
