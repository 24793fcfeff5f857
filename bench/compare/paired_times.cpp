#include "bench/compare/paired_times.h"

#include "bench/common/median_range.h"

namespace gnomon::bench {
namespace {

// The first frame makes maps and compiles, the second draws them for the first time at rest.
constexpr std::uint32_t kUntimedFrames = 2;
// Timings of a query may arrive this many frames late.
constexpr std::uint32_t kTimingLag = 3;

std::optional<double> median_of(std::vector<double> values) {
    const Spread spread = spread_of(std::move(values));
    return spread.count > 0 ? std::optional(spread.median) : std::nullopt;
}

}  // namespace

BlockOptions block_options(const gl::DeviceInfo& device, std::uint32_t frames) {
    return {device.is_software ? kUntimedFrames : kUntimedFrames + kTimingLag, frames};
}

std::vector<LightTimes> time_block(Stage& stage, std::span<const std::uint32_t> lights, const RowSetup& row,
                                   const BlockOptions& options) {
    std::vector<LightTimes> times(lights.size());
    if (stage.start_over(row.settings, row.kinds)) return times;
    for (const bool kept : {false, true}) {
        stage.set_economy(kept);
        std::vector<std::vector<double>> gpu_us(lights.size()), cpu_us(lights.size());
        for (std::uint32_t i = 0; i < options.settling + options.frames; ++i) {
            stage.run_frame();
            for (std::size_t k = 0; i >= options.settling && k < lights.size(); ++k) {
                const LightReport& report = stage.frame().report().lights[lights[k]];
                if (report.gpu_us) gpu_us[k].push_back(*report.gpu_us);
                cpu_us[k].push_back(report.cpu_us);
            }
        }
        for (std::size_t k = 0; k < lights.size(); ++k) {
            (kept ? times[k].kept_us : times[k].drawn_us) = median_of(gpu_us[k]);
            if (!kept) times[k].cpu_us = median_of(cpu_us[k]);
        }
    }
    return times;
}

void RatioRounds::add(const LightTimes& times, const LightTimes& base) {
    const auto put = [](const std::optional<double>& us, const std::optional<double>& base_us, std::vector<double>& all,
                        std::vector<double>& ratios) {
        if (us) all.push_back(*us);
        if (us && base_us && *base_us > 0.0) ratios.push_back(*us / *base_us);
    };
    put(times.drawn_us, base.drawn_us, gpu_us_, gpu_ratio_);
    put(times.kept_us, base.kept_us, kept_us_, kept_ratio_);
    if (times.cpu_us) cpu_us_.push_back(*times.cpu_us);
}

void RatioRounds::put_into(RowFigures& figures) const {
    figures.gpu_us = spread_of(gpu_us_);
    figures.gpu_ratio = spread_of(gpu_ratio_);
    figures.kept_us = spread_of(kept_us_);
    figures.kept_ratio = spread_of(kept_ratio_);
    figures.cpu_us = spread_of(cpu_us_);
}

}  // namespace gnomon::bench
