#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>
#include <utility>

#include "gnomon/window.h"
#include "sample_game/app/app.h"
#include "sample_game/app/fly_camera.h"
#include "sample_game/app/gamepad.h"
#include "sample_game/app/write_outputs.h"
#include "sample_game/gui/gui.h"

namespace gnomon::game {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kTitleEvery_s = 0.5;
constexpr double kLongestStep_s = 0.25;  // after a stall the walker does not leap through a wall
constexpr double kWalkPerSize = 0.1;     // the courtyard, 36 m corner to corner, is walked at about 3.6 m/s
constexpr double kFixedStep_s = 1.0 / 60.0;
constexpr std::chrono::milliseconds kMinimisedPause{50};

double walking_speed(const math::Aabb& bounds) {
    const double size_m = math::is_empty(bounds) ? 0.0 : glm::length(bounds.max - bounds.min);
    return kWalkPerSize * (size_m > 0.0 ? size_m : 10.0);
}

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// Scene time: by frame number if frames are counted, else by the clock.
class SceneClock {
public:
    explicit SceneClock(const CommandLine& line)
        : line_(line), paused_(!line.frames && line.time_s), time_s_(line.time_s.value_or(0.0)) {}

    double time_s(std::uint64_t frame) const {
        return line_.frames ? frame_time_s(line_, frame, *line_.frames) : time_s_;
    }
    void toggle_pause() { paused_ = !paused_; }
    void advance(double dt_s) {
        if (!paused_) time_s_ += dt_s;
    }
    bool runs() const { return line_.frames || !paused_; }

private:
    const CommandLine& line_;
    bool paused_;  // an endless run with --time stands still there until P is pressed
    double time_s_;
};

/// Frames per second, shown in the title now and then.
class TitleMeter {
public:
    /// Counts a frame and updates the title. `state` is shown at once when it changes; empty: none.
    void frame_done(Window& window, const std::string& state, const std::string& device) {
        ++frames_;
        if (state != state_ && !rate_.empty()) show(window, state, device);
        const double since_s = seconds(Clock::now() - start_);
        if (since_s < kTitleEvery_s) return;
        const auto fps = std::lround(static_cast<double>(frames_) / since_s);
        rate_ = std::to_string(fps) + " fps";
        show(window, state, device);
        frames_ = 0;
        start_ = Clock::now();
    }

private:
    void show(Window& window, const std::string& state, const std::string& device) {
        window.set_title("Gnomon - " + (state.empty() ? "" : state + " - ") + rate_ + " - " + device);
        state_ = state;
    }

    std::string state_, rate_;
    Clock::time_point start_ = Clock::now();
    std::uint64_t frames_ = 0;
};

bool pressed(const Input& input, Key key) { return input.pressed[static_cast<std::size_t>(key)]; }

/// Captures the mouse at a click. Tab frees it, and it stays free while the panel is shown.
void update_capture(const Input& input, Window& window, bool panel, bool& captured) {
    const bool want = (captured || input.mouse_pressed) && !pressed(input, Key::tab) && !panel;
    if (want == captured) return;
    captured = want;
    window.capture_mouse(captured);
}

std::string words_of_state(const GameWorld& world, const FrozenFrame& frozen) {
    if (frozen.judged()) return "frozen";
    if (frozen.on()) return "tracing the truth";
    return world.game ? to_text(world.game->state().phase) : "";
}

/// Freezes the frame that is shown, or lets it go.
void toggle_frozen(GameWorld& world, glm::uvec2 size_px, FrozenFrame& frozen) {
    if (frozen.on())
        frozen.thaw();
    else
        frozen.freeze(world.registry, world.library, size_px, trace_threads());
}

/// Motion in the window: that of the game, or that of a scene with a walk through it.
class Play {
public:
    Play(GameWorld& world, const CommandLine& line)
        : world_(world), line_(line), walker_(walking_speed(world.scene.bounds_ws)), clock_(line) {}

    /// Goes on to the next frame. `look`: the mouse turns the head. `stop_or_go`: the panel toggles the motion.
    void advance(const Input& input, bool look, bool stop_or_go, double dt_s) {
        if (world_.game)
            advance_game(input, look, stop_or_go, dt_s);
        else
            advance_scene(input, look, stop_or_go, dt_s);
        pads_ = input.gamepads;
        ++frame_;
    }
    /// Returns the number of frames so far.
    std::uint64_t frame() const { return frame_; }
    bool moving() const { return world_.game ? world_.game->state().phase == Phase::playing : clock_.runs(); }
    /// Returns the scene time of the last frame.
    double time_s() const {
        return world_.game && !line_.frames ? world_.game->state().time_s() : clock_.time_s(frame_ - 1);
    }

private:
    void advance_game(const Input& input, bool look, bool stop_or_go, double dt_s) {
        if (line_.frames) {
            world_.game->play_demo_until(frame_time_s(line_, frame_, *line_.frames));
        } else if (line_.demo) {
            world_.game->advance_demo(frame_ > 0 ? dt_s : line_.time_s.value_or(0.0));
        } else if (frame_ > 0) {
            GameInput both = together(to_game_input(input, look), gamepad_input(pads_, input.gamepads, dt_s));
            both.toggle_pause = both.toggle_pause != stop_or_go;
            world_.game->advance(dt_s, both);
        }
        world_.game->apply(world_.registry);
    }
    void advance_scene(const Input& input, bool look, bool stop_or_go, double dt_s) {
        if (pressed(input, Key::p) != stop_or_go) clock_.toggle_pause();
        if (frame_ > 0) {
            clock_.advance(dt_s);
            walker_.update(input, look, dt_s, world_.registry);
        }
        if (frame_ == 0 || clock_.runs()) set_time(world_.scene, clock_.time_s(frame_), world_.registry);
    }

    GameWorld& world_;
    const CommandLine& line_;
    FlyCamera walker_;
    SceneClock clock_;
    std::array<Gamepad, kMaxGamepads> pads_ = {};  // pads of the frame before
    std::uint64_t frame_ = 0;
};

}  // namespace

std::optional<Error> run_window(const CommandLine& line, GameWorld& world, spdlog::logger& log) {
    auto opened = Window::open({.size_px = line.size_px, .own_picture = false});
    if (!opened) return opened.error();
    Window& window = *opened.value();
    auto made = make_frame(line, world);
    if (!made) return made.error();
    Frame& frame = *made.value();
    auto drawn = Gui::create();
    if (!drawn) return drawn.error();
    Gui& gui = *drawn.value();

    FrameSettings settings = frame_settings(line);
    StatsFile stats(frame.device().name);
    gui.panel.debug = line.debug;
    gui.panel.budget = line.shadow_budget;
    Play play(world, line);
    TitleMeter title;
    bool captured = false, is_first = true;
    Clock::time_point last = Clock::now();
    while ((!line.frames || play.frame() < *line.frames) && window.begin_frame()) {
        const Input& input = window.input();
        if (play.frame() > 0 && pressed(input, Key::escape))
            break;  // the first frame is always drawn: there is something to write
        if (input.framebuffer_width == 0 || input.framebuffer_height == 0) {
            std::this_thread::sleep_for(kMinimisedPause);
            continue;
        }
        const double dt_s = line.frames ? kFixedStep_s : std::min(seconds(Clock::now() - last), kLongestStep_s);
        last = Clock::now();
        if (pressed(input, Key::f1)) gui.panel.shown = !gui.panel.shown;
        if (pressed(input, Key::f5) || std::exchange(gui.panel.toggle_frozen, false))
            toggle_frozen(world, settings.viewport_px, gui.frozen);
        if (pressed(input, Key::f2)) {
            if (gui.frozen.on())
                gui.frozen.choose_next();
            else
                next_debug_light(world, gui.panel.debug);
        }
        if (pressed(input, Key::f3)) next_debug_view(world, gui.panel.debug);
        if (pressed(input, Key::f6)) gui.panel.smooth_picture = !gui.panel.smooth_picture;
        if (pressed(input, Key::f4)) gui.panel.freeze_fits = !gui.panel.freeze_fits;
        const bool was_captured = captured;  // how the mouse came to where it clicked does not turn the head
        update_capture(input, window, gui.panel.shown, captured);
        const bool stop_or_go = std::exchange(gui.panel.toggle_motion, false);
        if (!gui.frozen.on()) play.advance(input, was_captured && captured, stop_or_go, dt_s);
        settings.viewport_px = window.size_px();
        settings.shadows = gui.panel.shadows;
        settings.debug = gui.panel.debug;
        settings.freeze_fits = gui.panel.freeze_fits;
        settings.shadow_budget = gui.panel.budget;
        // Errors and debug views are those of pixels' middles.
        const bool may_smooth = gui.panel.smooth_picture && !gui.frozen.on() && !gui.panel.debug.view;
        settings.still_samples = may_smooth ? still_samples(line) : 1;
        settings.smooth_edges = may_smooth && smooths_edges(line);
        settings.time_gpu = line.stats || gui.panel.shown;  // the panel shows times
        const bool first = std::exchange(is_first, false);
        if (first) {
            freeze_at_fit_camera(world, frame, settings);
            gui.panel.freeze_fits = settings.freeze_fits;
        }
        gui.panel.moving = play.moving();
        frame.run(world.registry, settings);
        if (frame.report().failure == gl::Failure::context_lost)
            return Error{.message = "the graphics context was lost, and the window with it", .rule = "gl.context_lost"};
        gui.frozen.update(frame, world.registry, settings.viewport_px);
        gui.draw(world, frame, settings.viewport_px, &input, dt_s);
        if (const Result<bool> shown = window.end_frame(frame.picture_texture()); !shown) return shown.error();
        if (first) log_warnings(world, frame.report(), log);
        if (line.stats && !gui.frozen.on())
            stats.add(frame.report(), play.frame() - 1, play.time_s(), world.game ? &world.game->state() : nullptr);
        title.frame_done(window, words_of_state(world, gui.frozen), frame.device().name);
    }
    if (line.screenshot && !finish_samples(world, frame, settings, [](const FrameReport&) {}))
        log.warn("the picture lacks samples: some shadow does not come to rest");
    if (line.screenshot && settings.still_samples > 1)
        gui.draw(world, frame, settings.viewport_px, nullptr, kFixedStep_s);
    return write_last_frame(line, world, frame, settings, &gui, stats);
}

}  // namespace gnomon::game
