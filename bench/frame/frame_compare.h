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
    struct DepthVariant {
        TimedFrames frames;  // frames of the first way; ratio: to the other's
        std::uint32_t views_drawn = 0;
        std::uint64_t bytes = 0;  // both of all lights in the last frame
    };
    struct Row {
        const char* words;
        const char* key;
        DepthVariant own, other;
    };
    std::vector<Row> rows;
};

/// Compares frames under two groups of settings. Rounds of `frames` frames take turns as in measure_frame_times().
/// Pixels are looked up in every frame, also still ones: this compares filters, not the savings of cached visibility.
/// Errors: "set.*".
Result<FramesAgainst> measure_frames_against(Stage& stage, std::span<const std::string> other_settings,
                                             std::uint32_t rounds, std::uint32_t frames);

std::string frames_against_table(const FramesAgainst& times);
std::string frames_against_json(const FramesAgainst& times);

}  // namespace gnomon::bench
