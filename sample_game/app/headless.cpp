#include <utility>

#include "gnomon/window.h"
#include "sample_game/app/app.h"
#include "sample_game/app/write_outputs.h"
#include "sample_game/gui/gui.h"

namespace gnomon::game {

namespace {

/// Everything that dies with a context.
struct Stage {
    std::unique_ptr<Window> window;
    std::unique_ptr<Frame> frame;
    std::unique_ptr<Gui> gui;
};

Result<Stage> make_stage(const CommandLine& line, const GameWorld& world,
                         std::shared_ptr<const shadow::History> history = nullptr) {
    auto window = Window::open({.size_px = line.size_px, .headless = true, .own_picture = false});
    if (!window) return window.error();
    auto frame = make_frame(line, world, std::move(history));
    if (!frame) return frame.error();
    Stage stage{std::move(window).value(), std::move(frame).value(), nullptr};
    if (world.game || line.debug.view || line.truth) {
        auto gui = Gui::create();
        if (!gui) return gui.error();
        stage.gui = std::move(gui).value();
    }
    return stage;
}

}  // namespace

std::optional<Error> run_headless(const CommandLine& line, GameWorld& world, spdlog::logger& log) {
    auto made = make_stage(line, world);
    if (!made) return made.error();
    std::optional<Stage> stage = std::move(made).value();
    FrameSettings settings = frame_settings(line);
    settings.leave_out_dim_lights = !line.visibility;  // --visibility shows every light by itself
    settings.repeatable = true;
    StatsFile stats(stage->frame->device().name);
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
        if (i == 0) freeze_at_fit_camera(world, *stage->frame, settings);
        stage->frame->run(world.registry, settings);
        if (stage->frame->report().failure == gl::Failure::context_lost) {
            log.warn("the graphics context was lost, and is made anew");
            auto history = stage->frame->history();
            stage.reset();
            auto again = make_stage(line, world, std::move(history));
            if (!again) return again.error();
            stage = std::move(again).value();
            freeze_at_fit_camera(world, *stage->frame, settings);
            stage->frame->run(world.registry, settings);
        }
        if (stage->gui) stage->gui->draw(world, *stage->frame, line.size_px, nullptr, kStep_s);
        if (i == 0) log_warnings(world, stage->frame->report(), log);
        if (line.stats) stats.add(stage->frame->report(), i, time_s, world.game ? &world.game->state() : nullptr);
    }
    const auto note = [&](const FrameReport& report) {
        if (line.stats)
            stats.add(report, frames - 1, frame_time_s(line, frames - 1, frames),
                      world.game ? &world.game->state() : nullptr);
    };
    if (!finish_samples(world, *stage->frame, settings, note))
        log.warn("the picture lacks samples: some shadow does not come to rest");
    if (stage->gui && settings.still_samples > 1)
        stage->gui->draw(world, *stage->frame, line.size_px, nullptr, kStep_s);
    return write_last_frame(line, world, *stage->frame, settings, stage->gui.get(), stats);
}

}  // namespace gnomon::game
