#pragma once
#include <optional>
#include <span>
#include <vector>

#include "bench/common/configuration.h"
#include "bench/common/stage.h"
#include "bench/compare/metrics_row.h"

namespace gnomon::bench {

/// Medians of one block of frames for one light: of its depth and lighting pass with every view drawn in every frame,
/// the same with kept maps, and of its shadow stages on the processor. Empty: the device did not say.
struct LightTimes {
    std::optional<double> drawn_us, kept_us, cpu_us;
};

struct BlockOptions {
    std::uint32_t settling = 1;  // frames before those that are timed: programs are there, maps are made
    std::uint32_t frames = 9;    // of each of the two
};
/// As many as it takes for timings that arrive late to be of the row that they are taken for.
BlockOptions block_options(const gl::DeviceInfo& device, std::uint32_t frames);

/// Times of the lights of these indices as `row` sets them. Rows whose settings are none have no times.
std::vector<LightTimes> time_block(Stage& stage, std::span<const std::uint32_t> lights, const RowSetup& row,
                                   const BlockOptions& options);

/// Blocks of one light in one row, round by round, each beside the base row's block of that round.
class RatioRounds {
public:
    void add(const LightTimes& times, const LightTimes& base);
    /// The spreads over the rounds so far.
    void put_into(RowFigures& figures) const;

private:
    std::vector<double> gpu_us_, gpu_ratio_, kept_us_, kept_ratio_, cpu_us_;
};

}  // namespace gnomon::bench
