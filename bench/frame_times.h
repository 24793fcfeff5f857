#pragma once
#include <cstdint>
#include <string>

#include "bench/spread.h"
#include "bench/stage.h"

namespace gnomon::bench {

/// Wall-clock times of whole frames, each from its start until the device has finished it.
struct FrameTimes {
    std::string scene, device;
    glm::uvec2 size_px{0, 0};
    Spread without_us;                                       // no light casts shadows
    Spread kept_us;                                          // shadows; the scene is still, so maps are kept
    Spread redrawn_us;                                       // shadows, economy off: every view drawn in every frame
    Spread kept_ratio, redrawn_ratio;                        // to `without`, one ratio of medians per round
    Spread moving_without_us;                                // everything moves (everything_moving()), no shadows
    Spread moving_us;                                        // the same frames with shadows
    Spread moving_ratio;                                     // one to the other
    std::uint32_t moving_views = 0, moving_views_drawn = 0;  // of the last of these frames
};

/// Each round runs `frames` frames of each kind, after as many as it takes to settle; rounds take turns, so that a
/// machine that slows down slows all kinds. What moves goes on by 1/60 s per frame, over the same times with shadows
/// and without.
FrameTimes measure_frame_times(Stage& stage, std::uint32_t rounds, std::uint32_t frames);

std::string frame_times_table(const FrameTimes& times);
std::string frame_times_json(const FrameTimes& times);

}  // namespace gnomon::bench
