#pragma once
#include <optional>
#include <span>
#include <vector>

#include "bench/common/configuration.h"
#include "bench/common/stage.h"
#include "bench/compare/metrics_row.h"

namespace gnomon::bench {

/// Median times of one light over a block of frames. drawn_us: depth and lighting pass with every view drawn in every
/// frame. kept_us: the same with kept maps. cpu_us: shadow stages. Empty: the device did not report it.
struct LightTimes {
    std::optional<double> drawn_us, kept_us, cpu_us;
};

struct BlockOptions {
    std::uint32_t settling = 1;  // frames before the timed ones: they compile programs and make maps
    std::uint32_t frames = 9;    // frames with drawn maps, and as many with kept ones
};
/// Returns the numbers of frames with which timings that arrive late still belong to their row.
BlockOptions block_options(const gl::DeviceInfo& device, std::uint32_t frames);

/// Times the lights of these indices under the settings of `row`. Invalid settings have no times.
std::vector<LightTimes> time_block(Stage& stage, std::span<const std::uint32_t> lights, const RowSetup& row,
                                   const BlockOptions& options);

/// Blocks of one light in one row, round by round, each beside the base row's block of that round.
class RatioRounds {
public:
    void add(const LightTimes& times, const LightTimes& base);
    /// Writes the spreads over the rounds so far.
    void put_into(RowFigures& figures) const;

private:
    std::vector<double> gpu_us_, gpu_ratio_, kept_us_, kept_ratio_, cpu_us_;
};

}  // namespace gnomon::bench
