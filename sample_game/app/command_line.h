#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/frame.h"
#include "gnomon/result.h"
#include "sample_game/support/settings/presets.h"

namespace gnomon::game {

/// The game's command line, checked as far as can be without touching a file.
struct CommandLine {
    std::optional<std::filesystem::path> scene;  // empty: the built-in scene
    std::optional<std::string> camera;           // name or index
    std::optional<std::string> fit_camera;       // name or index; empty: shadows are fitted to what is drawn
    std::optional<std::string> animation;        // name or index; empty: all at once
    glm::uvec2 size_px{1280, 720};
    bool headless = false;
    bool demo = false;
    std::optional<std::uint64_t> frames;   // > 0; empty: 1 headless, endless in a window
    std::optional<double> time_s;          // scene time of the last frame
    std::optional<float> exposure_ev;      // empty: automatic
    float mist_per_m = 0.0f;               // share of light that mist takes per metre; 0: none
    shadow::ShadowBudget shadow_budget;    // what shadows may take
    std::optional<std::uint32_t> samples;  // per pixel, > 0; empty: see still_samples()
    bool transparent = false;              // nothing is drawn behind all surfaces
    std::optional<bool> smooth;            // edges of moving pictures; empty: see smooths_edges()
    std::optional<std::filesystem::path> stats, screenshot, visibility;
    std::optional<std::filesystem::path> truth;  // the last frame beside its truth: picture with errors over it
    std::optional<std::string> truth_light;      // light with the errors to show; empty: each pixel's worst
    debug::Request debug;                        // its light is not checked against a scene
    const Preset* preset = nullptr;              // applied before the settings
    std::vector<std::string> settings;           // KEY=VALUE, each known to be right
    std::string print;                           // not empty (--help, --list): print it and exit with 0
};

/// Errors: rules "command_line" and those of apply_setting() and read_debug_request(); the message is one line.
Result<CommandLine> parse_command_line(int argc, const char* const* argv);

/// Returns whether the game is played: --demo, or a window without --scene, --camera, --fit-camera, --animation,
/// --frames and --time.
bool plays_game(const CommandLine& line);

/// Returns the samples per pixel of a picture that stands still: 64 in a window that runs until it is closed, else 1.
std::uint32_t still_samples(const CommandLine& line);

/// Returns whether edges of pictures with few samples are smoothed: in a window that runs until it is closed.
bool smooths_edges(const CommandLine& line);

/// Returns the scene time of frame `index` of `frames`. The last frame is at `line.time_s`; without it the first is at
/// 0.
double frame_time_s(const CommandLine& line, std::uint64_t index, std::uint64_t frames);

}  // namespace gnomon::game
