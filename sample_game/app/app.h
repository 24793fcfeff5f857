#pragma once
#include <spdlog/logger.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/frame.h"
#include "gnomon/result.h"
#include "sample_game/app/command_line.h"
#include "sample_game/app/stats_json.h"
#include "sample_game/game/game_world.h"

namespace gnomon::game {

/// Loads, spawns, applies --set, chooses the cameras, finds the light of --debug.
Result<std::unique_ptr<GameWorld>> make_world(const CommandLine& line);

/// Checks that every output named on the command line can be written. Makes the folder of --visibility.
std::optional<Error> check_outputs(const CommandLine& line);

/// Makes the renderer for the context that is current on this thread. `history`: its predecessor's, which lost its
/// context.
Result<std::unique_ptr<Frame>> make_frame(const CommandLine& line, const GameWorld& world,
                                          std::shared_ptr<const shadow::History> history = nullptr);

/// Returns the settings of frames by the command line.
FrameSettings frame_settings(const CommandLine& line);

/// Runs a frame for the camera of --fit-camera and freezes its fits, so that later frames show them from the other
/// camera. Does nothing without --fit-camera.
void freeze_at_fit_camera(GameWorld& world, Frame& frame, FrameSettings& settings);

/// Warns once of everything that is odd about the scene and yet no error.
void log_warnings(const GameWorld& world, const FrameReport& first_frame, spdlog::logger& log);

/// Returns the number of threads that a trace may take beside the drawing one.
unsigned trace_threads();

/// Writes --visibility and --stats from the last frame, a picture of `size_px`.
std::optional<Error> write_outputs(const CommandLine& line, const GameWorld& world, Frame& frame, glm::uvec2 size_px,
                                   const StatsFile& stats);

/// Writes the picture as it is to `file`. `transparent`: with its alpha.
std::optional<Error> write_picture(const std::filesystem::path& file, const Frame& frame, bool transparent);

/// Runs all frames without a window, as run_window() does in one. Returns nothing on success.
std::optional<Error> run_headless(const CommandLine& line, GameWorld& world, spdlog::logger& log);
std::optional<Error> run_window(const CommandLine& line, GameWorld& world, spdlog::logger& log);

}  // namespace gnomon::game
