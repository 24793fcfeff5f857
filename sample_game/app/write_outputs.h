#pragma once
#include <functional>

#include "sample_game/app/app.h"
#include "sample_game/gui/gui.h"

namespace gnomon::game {

/// Runs the last frame again, in which nothing moves, until its picture has all samples of `settings`. `after_frame`
/// takes each report. Returns whether it has them.
bool finish_samples(GameWorld& world, Frame& frame, const FrameSettings& settings,
                    const std::function<void(const FrameReport&)>& after_frame);

/// Writes the outputs that the command line names, from the last frame, run with `settings`. With --truth it also
/// traces the frame and writes its picture with the errors over it. `gui`: needed for --truth alone.
std::optional<Error> write_last_frame(const CommandLine& line, GameWorld& world, Frame& frame,
                                      const FrameSettings& settings, Gui* gui, StatsFile& stats);

}  // namespace gnomon::game
