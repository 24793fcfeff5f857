#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/frame_system.h"
#include "tests/system/silent_device.h"

// Runs frames of a scene on a device that keeps nothing, for .ci/same_cost.py, which counts their instructions.
// usage: gnomon_frame_walk SCENE still|moving FRAMES. SCENE: courtyard, valley, spheres or a glTF file.
int main(int count, char** arguments) {
    using namespace gnomon;
    if (count != 4) return std::fputs("usage: gnomon_frame_walk SCENE still|moving FRAMES\n", stderr), 2;
    const std::string_view name = arguments[1];
    const bool moving = std::string_view(arguments[2]) == "moving";
    auto scene = game::load_scene(name == "courtyard" ? std::optional<std::filesystem::path>() : name);
    if (!scene) return std::fprintf(stderr, "%s\n", to_line(scene.error()).c_str()), 2;
    ecs::Registry registry;
    assets::MeshLibrary library;
    auto spawned = game::spawn_scene(std::move(scene).value(), registry, library);
    SilentDevice device;
    auto frame = FrameSystem::create(device, library);
    if (!frame) return std::fprintf(stderr, "%s\n", to_line(frame.error()).c_str()), 2;
    for (int i = 0; i < std::atoi(arguments[3]); ++i) {
        if (moving || i == 0) game::set_time(spawned, i / 60.0, registry);
        frame.value()->run(registry, {});
    }
    // A frame that draws nothing would cost nothing.
    return frame.value()->report().lights.empty() ? 1 : 0;
}
