#include "engine/platform/context.h"
#include "sample_game/app.h"
#include "sample_game/gui/gui.h"

namespace gnomon::game {

std::optional<Error> run_headless(const CommandLine& line, GameWorld& world, spdlog::logger& log) {
    auto context = platform::make_headless_context(false);
    if (!context) return context.error();
    auto made = make_renderer(line, world);
    if (!made) return made.error();
    Renderer renderer = std::move(made).value();

    std::unique_ptr<Gui> gui;
    if (world.game || line.debug.view) {
        auto drawn = Gui::create(*renderer.device);
        if (!drawn) return drawn.error();
        gui = std::move(drawn).value();
    }
    FrameSettings settings;
    settings.viewport_px = line.size_px;
    settings.exposure_ev = line.exposure_ev;
    settings.debug = line.debug;
    StatsFile stats(renderer.device->info().name);
    const bool to_the_end = line.demo && !line.frames && !line.time_s;
    const std::uint64_t frames = line.frames.value_or(1);
    for (std::uint64_t i = 0; to_the_end ? !world.game->ended() : i < frames; ++i) {
        const double time_s = frame_time_s(line, i, frames);
        if (world.game) {
            world.game->play_demo_until(time_s);
            world.game->apply(world.registry);
        } else {
            apply_motion(world.scene.moving, time_s, world.registry);
        }
        renderer.frame->run(world.registry, settings);
        if (gui) gui->draw(world, *renderer.frame, line.size_px, nullptr, kStep_s, false);
        if (i == 0) log_warnings(world, renderer.frame->report(), log);
        if (line.stats) 
            stats.add(renderer.frame->report(), i, time_s, world.game ? &world.game->state() : nullptr);
    }
    return write_outputs(line, *renderer.frame, line.size_px, stats);
}

}  // namespace gnomon::game
