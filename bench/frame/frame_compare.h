#pragma once
#include <span>
#include <string>
#include <vector>

#include "bench/common/timed_blocks.h"

namespace gnomon::bench {

/// Whole frames of two ways to set every light, in one run: what the one costs where the other is what is had.
struct FramesAgainst {
    std::string scene, device;
    std::vector<std::string> settings, other_settings;  // "KEY=VALUE"; the others come on top of the first
    struct Way {
        TimedFrames frames;  // of the first way, ratio: to the other's
        std::uint32_t views_drawn = 0;
        std::uint64_t bytes = 0;  // both of all lights in the last frame
    };
    struct Held {
        const char* words;
        const char* key;
        Way own, other;
    };
    std::vector<Held> held;
};

/// Pixels are looked up in every frame, still ones as well: this tells filters apart, not what keeping saves. Rounds of
/// `frames` frames as measure_frame_times(). Errors: "set.*".
Result<FramesAgainst> measure_frames_against(Stage& stage, std::span<const std::string> other_settings,
                                             std::uint32_t rounds, std::uint32_t frames);

std::string frames_against_table(const FramesAgainst& times);
std::string frames_against_json(const FramesAgainst& times);

}  // namespace gnomon::bench
