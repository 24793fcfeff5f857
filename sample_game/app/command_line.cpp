#include "sample_game/app/command_line.h"

#include <CLI/CLI.hpp>
#include <cmath>

#include "sample_game/app/debug_option.h"
#include "sample_game/gui/keys.h"
#include "sample_game/support/scene/mist.h"
#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/settings/light_settings.h"
#include "sample_game/support/settings/parse_number.h"

namespace gnomon::game {
namespace {

constexpr std::uint64_t kMaxSize_px = 16384;
constexpr std::uint64_t kMaxFrames = 100'000'000;
constexpr double kMaxTime_s = 1.0e9;
constexpr double kMaxExposure_ev = 64.0;
constexpr double kMaxBudget_ms = 1.0e6;
constexpr double kFramesPerSecond = 60.0;
constexpr std::uint64_t kMaxSamples = 1024;
constexpr std::uint32_t kWindowSamples = 64;

/// Arguments as typed, before they are parsed.
struct Typed {
    std::string scene, camera, fit_camera, animation, size, frames, time, exposure, mist, samples, smooth, shadow_bytes,
        shadow_ms, shadow_rays, stats, screenshot, visibility, truth, truth_light, preset, debug;
    std::vector<std::string> settings;
    bool headless = false, demo = false, list = false, transparent = false;
};

Error wrong(const std::string& message) { return {.message = on_one_line(message), .rule = "command_line"}; }

void declare(CLI::App& app, Typed& typed) {
    app.set_help_flag("-h,--help", "print this and exit");
    app.add_option("--scene", typed.scene, kSceneHelp);
    app.add_option("--camera", typed.camera, "NAME|INDEX (default: the first, else framed on the scene)");
    app.add_option("--fit-camera", typed.fit_camera,
                   "NAME|INDEX: fit shadows to this camera, as it stands in the first frame");
    app.add_option("--animation", typed.animation, "NAME|INDEX: this animation alone (default: all at once)");
    app.add_option("--size", typed.size, "WxH: picture size, each 1 to 16384 (default: 1280x720)");
    app.add_flag("--headless", typed.headless, "EGL, no window");
    app.add_flag("--demo", typed.demo, "the game plays itself: a scripted walk across the courtyard");
    app.add_option("--frames", typed.frames, "N: frames to run, then exit");
    app.add_option("--time", typed.time, "SECONDS: scene time of the last frame");
    app.add_option("--exposure", typed.exposure, "EV|auto (default: auto)");
    app.add_option("--mist", typed.mist,
                   "X: mist in the lights, which takes this share of light per metre, 0 to 10 (default: 0, none)");
    app.add_option(
        "--samples", typed.samples,
        "N: samples per pixel of a picture that stands still (default: 64 in a window without --frames, else 1)");
    app.add_option("--smooth", typed.smooth,
                   "on|off: smooth edges of pictures with few samples (default: on in a window without --frames)");
    app.add_option("--shadow-bytes", typed.shadow_bytes,
                   "N|any: bytes that all shadow maps may hold (default: 256 MB, more beyond 1920x1080)");
    app.add_option("--shadow-ms", typed.shadow_ms,
                   "X: milliseconds of the GPU that shadows may take in a frame (default: any)");
    app.add_option("--shadow-rays", typed.shadow_rays,
                   "N: rays that pixels of exact lights may ask in a frame (default: any)");
    app.add_option("--stats", typed.stats, "F.json: per frame and light times, counts, report");
    app.add_option("--screenshot", typed.screenshot, "F.png: the last frame");
    app.add_flag("--transparent", typed.transparent,
                 "nothing behind the surfaces: --screenshot has alpha, to lay it over another picture");
    app.add_option("--visibility", typed.visibility,
                   "DIR: DIR/<light>.pfm, the visible fraction of each shadowed light");
    app.add_option(
        "--truth", typed.truth,
        "F.png: the last frame with its errors against ray-traced truth over it; their figures go to --stats");
    app.add_option("--truth-light", typed.truth_light, "NAME: with --truth, this light's errors (default: the worst)");
    app.add_option("--preset", typed.preset, "fast|default|high: settings of every light, before --set");
    app.add_option("--set", typed.settings, "KEY=VALUE: a setting of every light with a shadow; repeatable")
        ->expected(1)
        ->allow_extra_args(false)
        ->take_all();
    app.add_option("--debug", typed.debug, "NAME[:LIGHT[:MAP]]: a debug view over the picture, see --list");
    app.add_flag("--list", typed.list, "print what --set, --preset and --debug know, and exit");
    app.footer(
        list_keys() +
        "The game, in a window without --scene, --camera, --fit-camera, --animation, --frames and --time: cross\n"
        "the courtyard to the gate unseen. With any of these, the scene is looked at.");
}

/// Reads a side of the picture, 1 to kMaxSize_px pixels. Returns 0 if `text` is none.
std::uint64_t read_side(std::string_view text) {
    const std::uint64_t side = read_count(text).value_or(0);
    return side <= kMaxSize_px ? side : 0;
}

std::optional<Error> read_size(const std::string& text, glm::uvec2& size_px) {
    const std::size_t cross = std::min(text.find('x'), text.size());
    const std::string_view view(text);
    const std::uint64_t width = read_side(view.substr(0, cross));
    const std::uint64_t height = read_side(view.substr(std::min(cross + 1, view.size())));
    if (width == 0 || height == 0)
        return wrong("--size: '" + text + "' is not WxH with each of 1 to " + std::to_string(kMaxSize_px));
    size_px = {width, height};
    return std::nullopt;
}

std::optional<Error> read_numbers(const Typed& typed, const CLI::App& app, CommandLine& line) {
    if (app.count("--frames") > 0) {
        line.frames = read_count(typed.frames);
        if (!line.frames || *line.frames < 1 || *line.frames > kMaxFrames)
            return wrong("--frames: '" + typed.frames + "' is not a number of 1 to " + std::to_string(kMaxFrames));
    }
    if (app.count("--time") > 0) {
        line.time_s = read_number(typed.time);
        if (!line.time_s || !(std::abs(*line.time_s) <= kMaxTime_s))
            return wrong("--time: '" + typed.time + "' is not a number of seconds within +-1e9");
    }
    if (app.count("--exposure") > 0 && typed.exposure != "auto") {
        const auto exposure = read_number(typed.exposure);
        if (!exposure || !(std::abs(*exposure) <= kMaxExposure_ev))
            return wrong("--exposure: '" + typed.exposure + "' is neither auto nor an EV within +-64");
        line.exposure_ev = static_cast<float>(*exposure);
    }
    if (app.count("--mist") > 0) {
        const auto mist = read_number(typed.mist);
        if (!mist || !(*mist >= 0.0 && *mist <= static_cast<double>(kMostMist_per_m)))
            return wrong("--mist: '" + typed.mist + "' is not a share of light per metre of 0 to 10");
        line.mist_per_m = static_cast<float>(*mist);
    }
    if (app.count("--samples") > 0) {
        const std::uint64_t samples = read_count(typed.samples).value_or(0);
        if (samples < 1 || samples > kMaxSamples)
            return wrong("--samples: '" + typed.samples + "' is not a number of 1 to " + std::to_string(kMaxSamples));
        line.samples = static_cast<std::uint32_t>(samples);
    }
    if (app.count("--smooth") > 0) {
        if (typed.smooth != "on" && typed.smooth != "off")
            return wrong("--smooth: '" + typed.smooth + "' is neither on nor off");
        line.smooth = typed.smooth == "on";
    }
    if (app.count("--shadow-bytes") > 0) {
        line.shadow_budget.bytes =
            typed.shadow_bytes == "any" ? shadow::ShadowBudget::kUnlimited : read_count(typed.shadow_bytes).value_or(0);
        if (line.shadow_budget.bytes == 0)
            return wrong("--shadow-bytes: '" + typed.shadow_bytes + "' is neither a number of bytes above 0 nor any");
    }
    if (app.count("--shadow-ms") > 0) {
        const auto ms = read_number(typed.shadow_ms);
        if (!ms || !(*ms > 0.0 && *ms <= kMaxBudget_ms))
            return wrong("--shadow-ms: '" + typed.shadow_ms + "' is not a number of milliseconds above 0, at most 1e6");
        line.shadow_budget.gpu_ms = static_cast<float>(*ms);
    }
    if (app.count("--shadow-rays") > 0) {
        line.shadow_budget.rays = read_count(typed.shadow_rays).value_or(0);
        if (line.shadow_budget.rays == 0)
            return wrong("--shadow-rays: '" + typed.shadow_rays + "' is not a number of rays above 0");
    }
    return std::nullopt;
}

std::optional<Error> read_names(const Typed& typed, const CLI::App& app, CommandLine& line) {
    const auto read = [&](const char* flag, const std::string& text, auto& value) {
        if (app.count(flag) == 0) return true;
        value = text;
        return !text.empty();
    };
    const bool all = read("--scene", typed.scene, line.scene) && read("--camera", typed.camera, line.camera) &&
                     read("--fit-camera", typed.fit_camera, line.fit_camera) &&
                     read("--animation", typed.animation, line.animation) && read("--stats", typed.stats, line.stats) &&
                     read("--screenshot", typed.screenshot, line.screenshot) &&
                     read("--visibility", typed.visibility, line.visibility) &&
                     read("--truth", typed.truth, line.truth) &&
                     read("--truth-light", typed.truth_light, line.truth_light);
    return all ? std::nullopt : std::optional(wrong("an empty name was given"));
}

Result<CommandLine> understand(const Typed& typed, const CLI::App& app) {
    CommandLine line;
    line.headless = typed.headless;
    line.demo = typed.demo;
    line.transparent = typed.transparent;
    line.settings = typed.settings;
    if (typed.list) line.print = list_settings() + list_presets() + list_debug_views();
    if (app.count("--size") > 0)
        if (auto error = read_size(typed.size, line.size_px)) return *error;
    if (auto error = read_numbers(typed, app, line)) return *error;
    if (auto error = read_names(typed, app, line)) return *error;
    if (line.demo && (line.scene || line.camera || line.fit_camera || line.animation))
        return wrong(
            "--demo plays the built-in scene with its own camera: no --scene, --camera, --fit-camera or --animation "
            "goes with it");
    if (line.truth_light && !line.truth) return wrong("--truth-light says whose errors --truth shows: give both");
    if (app.count("--preset") > 0) {
        line.preset = find_preset(typed.preset);
        if (!line.preset) return wrong("--preset: '" + typed.preset + "' is none; --list shows them");
    }
    if (app.count("--debug") > 0) {
        Result<debug::Request> debug = read_debug_request(typed.debug);
        if (!debug) return debug.error();
        line.debug = std::move(debug).value();
    }
    LightSettings any;
    for (const std::string& setting : typed.settings)
        if (auto error = apply_setting(any, setting)) return *error;
    return line;
}

}  // namespace

Result<CommandLine> parse_command_line(int argc, const char* const* argv) {
    CLI::App app("Gnomon's sample game: shadows of sun, spot and point lights", "gnomon_game");
    Typed typed;
    declare(app, typed);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        CommandLine line;
        line.print = app.help();
        return line;
    } catch (const CLI::Error& error) {
        return wrong(error.what());
    }
    return understand(typed, app);
}

bool plays_game(const CommandLine& line) {
    return line.demo || !(line.headless || line.scene || line.camera || line.fit_camera || line.animation ||
                          line.frames || line.time_s);
}

std::uint32_t still_samples(const CommandLine& line) {
    return line.samples.value_or(line.headless || line.frames ? 1 : kWindowSamples);
}

bool smooths_edges(const CommandLine& line) { return line.smooth.value_or(!line.headless && !line.frames); }

double frame_time_s(const CommandLine& line, std::uint64_t index, std::uint64_t frames) {
    if (!line.time_s) return static_cast<double>(index) / kFramesPerSecond;
    return *line.time_s - static_cast<double>(frames - 1 - index) / kFramesPerSecond;
}

}  // namespace gnomon::game
