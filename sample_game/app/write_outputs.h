#pragma once
#include "sample_game/app/app.h"
#include "sample_game/gui/gui.h"

namespace gnomon::game {

/// Writes what the command line asks of the frame that was run last, with these settings: its outputs and, with
/// --truth, once it is traced and judged, its picture again with the errors over it. `gui`: needed for that alone.
std::optional<Error> write_last_frame(const CommandLine& line, GameWorld& world, Frame& frame,
                                      const FrameSettings& settings, Gui* gui, StatsFile& stats);

}  // namespace gnomon::game
