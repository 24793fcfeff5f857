#include "sample_game/app/app.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "gnomon/light.h"
#include "gnomon/window.h"
#include "sample_game/app/debug_option.h"
#include "sample_game/support/files/image_files.h"
#include "sample_game/support/scene/mist.h"
#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/scene/scene_proxies.h"
#include "sample_game/support/settings/light_settings.h"
#include "sample_game/support/settings/parse_number.h"

namespace gnomon::game {

Result<std::unique_ptr<GameWorld>> make_world(const CommandLine& line) {
    const bool game = plays_game(line);
    Result<assets::SceneData> data = game ? load_game_scene() : load_scene(line.scene);
    if (!data) return data.error();
    std::optional<Level> level;
    if (game) {
        Result<Level> made = courtyard_level(data.value());
        if (!made) return made.error();
        level = std::move(made).value();
    }
    auto world = std::make_unique<GameWorld>();
    for (const std::string& warning : data.value().warnings)
        world->warnings.push_back(line.scene ? line.scene->string() + ": " + warning : warning);
    world->scene = spawn_scene(std::move(data).value(), world->registry, world->library);
    set_mist(world->scene.bounds_ws, line.mist_per_m, world->mist, world->registry);
    if (level) world->game = std::make_unique<GameSession>(std::move(*level), world->scene, world->registry);
    if (line.animation) {
        const Result<std::size_t> animation = find_animation(world->scene.animations, *line.animation);
        if (!animation) return animation.error();
        world->scene.played = played_channels(world->scene.animations, world->scene.nodes, animation.value());
    }
    if (line.camera) {
        const Result<std::size_t> camera = find_camera(world->scene, *line.camera);
        if (!camera) return camera.error();
        world->camera = camera.value();
        activate_camera(world->scene, world->camera, world->registry);
    }
    if (line.fit_camera) {
        const Result<std::size_t> camera = find_camera(world->scene, *line.fit_camera, "--fit-camera");
        if (!camera) return camera.error();
        world->fit_camera = camera.value();
    }
    for (const NamedEntity& light : world->scene.lights) {
        change_settings(world->registry, light.entity, [&](LightSettings& settings) {
            if (line.preset) apply_preset(*line.preset, settings);
            for (const std::string& setting : line.settings) apply_setting(settings, setting);
        });
    }
    provide_proxies(world->scene, world->registry, world->library);
    std::vector<std::string> shadowed;
    for (const NamedEntity& light : world->scene.lights)
        if (world->registry.has<LightShadow>(light.entity)) shadowed.push_back(light.name);
    if (auto error = check_debug_light(line.debug, shadowed)) return *error;
    if (line.truth_light)
        if (auto error = check_shadowed_light("--truth-light", *line.truth_light, shadowed)) return *error;
    return world;
}

std::optional<Error> check_outputs(const CommandLine& line) {
    for (const auto& file : {line.stats, line.screenshot, line.truth})
        if (file)
            if (auto error = check_writable(*file)) return error;
    return line.visibility ? make_writable_folder(*line.visibility) : std::nullopt;
}

void freeze_at_fit_camera(GameWorld& world, Frame& frame, FrameSettings& settings) {
    if (!world.fit_camera) return;
    settings.freeze_fits = true;
    activate_camera(world.scene, *world.fit_camera, world.registry);
    frame.run(world.registry, settings);
    activate_camera(world.scene, world.camera, world.registry);
}

FrameSettings frame_settings(const CommandLine& line) {
    return {.viewport_px = line.size_px,
            .exposure_ev = line.exposure_ev,
            .debug = line.debug,
            .shadow_budget = line.shadow_budget,
            .still_samples = line.debug.view ? 1 : still_samples(line),
            .smooth_edges = !line.debug.view && smooths_edges(line),
            .transparent = line.transparent,
            .time_gpu = line.stats.has_value()};
}

Result<std::unique_ptr<Frame>> make_frame(const CommandLine& line, const GameWorld& world,
                                          std::shared_ptr<const shadow::History> history) {
    auto frame = Frame::create(world.library, {.history = std::move(history)});
    if (!frame) return frame.error();
    const std::uint32_t most_px = frame.value()->device().max_side_px;
    if (line.size_px.x > most_px || line.size_px.y > most_px)
        return Error{.message = "--size: this device draws up to " + std::to_string(most_px) + " pixels a side",
                     .rule = "command_line"};
    return std::move(frame).value();
}

void log_warnings(const GameWorld& world, const FrameReport& first_frame, spdlog::logger& log) {
    for (const std::string& warning : world.warnings) log.warn(on_one_line(warning));
    constexpr std::size_t kShownDropped = 64;  // as many lines as the loader gives
    const std::vector<DroppedEntity>& dropped = first_frame.dropped;
    for (std::size_t i = 0; i < std::min(dropped.size(), kShownDropped); ++i)
        log.warn(on_one_line("'" + dropped[i].name + "' is left out: " + reason_code(dropped[i].reason)));
    if (dropped.size() > kShownDropped) log.warn(std::to_string(dropped.size() - kShownDropped) + " more are left out");
}

unsigned trace_threads() { return std::max(std::thread::hardware_concurrency(), 2u) - 1u; }

std::optional<Error> write_picture(const std::filesystem::path& file, const Frame& frame, bool transparent) {
    if (frame.picture_texture() == 0)
        return Error{.message = "the device could not draw the picture", .rule = "output.picture"};
    const Result<bool> written = write_screenshot(frame.picture_texture(), file.string(),
                                                  transparent ? PictureAlpha::premultiplied : PictureAlpha::opaque);
    return written ? std::nullopt : std::optional(written.error());
}

std::optional<Error> write_outputs(const CommandLine& line, const GameWorld& world, Frame& frame, glm::uvec2 size_px,
                                   const StatsFile& stats) {
    if (line.visibility) {
        std::vector<float> values;
        for (const LightReport& light : frame.report().lights) {
            if (!world.registry.has<LightShadow>(light.entity)) continue;
            if (!frame.read_visibility(light.entity, values))
                return Error{.message = "the device could not draw the visibility of " + light.name,
                             .rule = "output.visibility"};
            if (auto error = write_pfm(*line.visibility / (light.name + ".pfm"), size_px.x, size_px.y, values))
                return error;
        }
    }
    return line.stats ? stats.write(*line.stats) : std::nullopt;
}

}  // namespace gnomon::game
