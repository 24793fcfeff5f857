#pragma once
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "bench/common/median_range.h"
#include "bench/common/stage.h"
#include "gnomon/components.h"

namespace gnomon::bench {

inline constexpr double kStep_s = 1.0 / 60.0;  // by which what moves goes on from frame to frame

/// Times of each frame of a block. us: wall-clock time from its start until the device has finished it. cpu_us: the
/// process's time on all cores, which other processes do not change.
struct BlockTimes {
    std::vector<double> us, cpu_us;
};

/// Frames of one kind in all rounds.
struct TimedFrames {
    Spread us, cpu_us;
    Spread ratio, cpu_ratio;  // ratio to the base, of medians per round; none without a base
};

/// Collects timed frames. Rounds of several kinds take turns, so that a machine that slows down slows all kinds.
class TimedRounds {
public:
    struct Medians {
        double us = 0.0, cpu_us = 0.0;
    };
    /// Adds a round. `base`: medians that it is compared with; null: none.
    Medians add(const BlockTimes& block, const Medians* base);
    TimedFrames frames() const;

private:
    BlockTimes all_, ratios_;
};

using BeforeFrame = std::function<void(std::uint32_t frame)>;

nlohmann::ordered_json to_json(const Spread& spread);

inline constexpr std::uint32_t kSettlingFrames = 4;  // the third one of a still scene fills what is kept

/// Runs `settling` frames, then `frames` that are timed; `before` each.
BlockTimes time_frames(Stage& stage, std::uint32_t frames, const BeforeFrame& before,
                       std::uint32_t settling = kSettlingFrames);

/// The first camera ahead along its own view, at a walker's 1.4 m/s; back in its place with the end of this.
class Walk {
public:
    explicit Walk(Stage& stage);
    ~Walk() { place(0.0); }
    Walk(const Walk&) = delete;
    Walk& operator=(const Walk&) = delete;
    void place(double time_s);

private:
    Stage& stage_;
    ecs::Entity camera_;
    Transform rest_;
};

}  // namespace gnomon::bench
