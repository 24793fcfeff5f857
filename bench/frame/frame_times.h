#pragma once
#include <cstdint>
#include <string>

#include "bench/common/stage.h"
#include "bench/common/timed_blocks.h"

namespace gnomon::bench {

/// Whole frames without shadows and with them; ratios are to the same frames without.
struct FrameTimes {
    std::string scene, device;
    glm::uvec2 size_px{0, 0};
    TimedFrames without;                                     // no light casts shadows
    TimedFrames kept;                                        // the scene is still: maps, and what pixels saw, are kept
    TimedFrames looked_up;                                   // maps are kept, and looked up in every frame
    TimedFrames redrawn;                                     // economy off: every view drawn in every frame
    TimedFrames walk_without, walk;                          // the camera walks ahead at 1.4 m/s
    TimedFrames moving_without, moving;                      // everything moves (everything_moving())
    std::uint32_t moving_views = 0, moving_views_drawn = 0;  // numbers of the last moving frame
};

/// Measures frames of each kind. A round runs `frames` frames of each kind, after enough to settle. Rounds take turns,
/// so that a machine that slows down slows all kinds. Motion goes on by 1/60 s per frame, over the same times with
/// shadows and without.
FrameTimes measure_frame_times(Stage& stage, std::uint32_t rounds, std::uint32_t frames);

/// Returns the meaning of the tables, for --help.
std::string frame_legend();
std::string frame_times_table(const FrameTimes& times);
std::string frame_times_json(const FrameTimes& times);

}  // namespace gnomon::bench
