#include <utility>

#include "engine/platform/context.h"
#include "sample_game/app/app.h"
#include "sample_game/app/write_outputs.h"
#include "sample_game/gui/gui.h"

namespace gnomon::game {

namespace {

/// Everything that dies with a context.
struct Stage {
    std::unique_ptr<platform::Context> context;
    Renderer renderer;
    std::unique_ptr<Gui> gui;
};

Result<Stage> make_stage(const CommandLine& line, const GameWorld& world, const shadow::History& fit_history = {}) {
    auto context = platform::make_headless_context(false);
    if (!context) return context.error();
    auto renderer = make_renderer(line, world, fit_history);
    if (!renderer) return renderer.error();
    Stage stage{std::move(context).value(), std::move(renderer).value(), nullptr};
    if (world.game || line.debug.view || line.truth) {
        auto drawn = Gui::create(*stage.renderer.device);
        if (!drawn) return drawn.error();
        stage.gui = std::move(drawn).value();
    }
    return stage;
}

}  // namespace

std::optional<Error> run_headless(const CommandLine& line, GameWorld& world, spdlog::logger& log) {
    auto made = make_stage(line, world);
    if (!made) return made.error();
    std::optional<Stage> stage = std::move(made).value();
    FrameSettings settings;
    settings.viewport_px = line.size_px;
    settings.exposure_ev = line.exposure_ev;
    settings.shadow_budget = line.shadow_budget;
    settings.leave_out_dim_lights = !line.visibility;  // --visibility shows every light by itself
    settings.debug = line.debug;
    settings.repeatable = true;
    StatsFile stats(stage->renderer.device->info().name);
    const bool to_the_end = line.demo && !line.frames && !line.time_s;
    const std::uint64_t frames = line.frames.value_or(1);
    for (std::uint64_t i = 0; to_the_end ? !world.game->ended() : i < frames; ++i) {
        const double time_s = frame_time_s(line, i, frames);
        if (world.game) {
            world.game->play_demo_until(time_s);
            world.game->apply(world.registry);
        } else {
            set_time(world.scene, time_s, world.registry);
        }
        if (i == 0) freeze_at_fit_camera(world, *stage->renderer.frame, settings);
        stage->renderer.frame->run(world.registry, settings);
        if (stage->renderer.frame->report().failure == gl::Failure::context_lost) {
            log.warn("the graphics context was lost, and is made anew");
            const shadow::History fit_history = stage->renderer.frame->fit_history();
            stage.reset();
            auto again = make_stage(line, world, fit_history);
            if (!again) return again.error();
            stage = std::move(again).value();
            freeze_at_fit_camera(world, *stage->renderer.frame, settings);
            stage->renderer.frame->run(world.registry, settings);
        }
        FrameSystem& frame = *stage->renderer.frame;
        if (stage->gui) stage->gui->draw(world, frame, line.size_px, nullptr, kStep_s, false);
        if (i == 0) log_warnings(world, frame.report(), log);
        if (line.stats) stats.add(frame.report(), i, time_s, world.game ? &world.game->state() : nullptr);
    }
    return write_last_frame(line, world, *stage->renderer.frame, settings, stage->gui.get(), stats);
}

}  // namespace gnomon::game
