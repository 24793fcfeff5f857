#include "bench/check/check_programs.h"
#include "bench/check/check_rows.h"
#include "bench/check/check_scene.h"
#include "engine/gl/device_recording.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "sample_game/support/settings/light_settings.h"
#include "systems/frame_system.h"

namespace gnomon::bench {
namespace {

constexpr glm::uvec2 kTiny_px{64, 36};
constexpr std::uint32_t kMap_px = 32;
constexpr int kFrames = 4;  // the third of a still scene keeps what pixels saw, the fourth reads it

}  // namespace

std::vector<gl::ProgramDesc> programs_of_rows() {
    gl::DeviceInfo info = gl::RecordingDevice::default_info();
    info.vertex_layer = true;
    gl::RecordingDevice device(info);
    ecs::Registry world;
    assets::MeshLibrary library;
    const game::SpawnedScene spawned = game::spawn_scene(check_scene(), world, library);
    const auto frame = FrameSystem::create(device, library);
    if (!frame) return {};
    FrameSettings settings;
    settings.viewport_px = kTiny_px;
    for (const CheckRowSetup& setup : check_row_setups()) {
        // Without a shadow in between, so that no map stays that another route has drawn.
        for (const game::NamedEntity& light : spawned.lights) world.remove<LightShadow>(light.entity);
        frame.value()->run(world, settings);
        for (const game::NamedEntity& light : spawned.lights) {
            game::LightSettings settings_of_row;
            for (const std::string& setting : setup.settings) (void)game::apply_setting(settings_of_row, setting);
            settings_of_row.shadow.resolution_px = kMap_px;
            game::put_settings(world, light.entity, settings_of_row);
        }
        for (int i = 0; i < kFrames; ++i) frame.value()->run(world, settings);
    }
    std::vector<gl::ProgramDesc> programs;
    for (const gl::ResourceCall& call : device.resource_calls()) {
        if (call.kind != gl::ResourceCall::Kind::create_program) continue;
        const gl::ProgramDesc* program = device.program(gl::ProgramHandle{call.id});
        if (program) programs.push_back(*program);
    }
    return programs;
}

}  // namespace gnomon::bench
