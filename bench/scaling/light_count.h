#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/common/median_range.h"
#include "bench/common/stage.h"

/// Cost of shadows by the number of lights.
namespace gnomon::bench {

/// still: nothing moves; mover: one column slides to and fro before the camera; walk: the camera walks.
enum class DemandMotion : std::uint8_t { still, mover, walk };
enum class DemandMode : std::uint8_t { without, economy, redrawn };  // no shadows; economy on; off
inline constexpr std::array kDemandMotions = {DemandMotion::still, DemandMotion::mover, DemandMotion::walk};
inline constexpr std::array kDemandModes = {DemandMode::without, DemandMode::economy, DemandMode::redrawn};
const char* to_text(DemandMotion motion);
const char* to_text(DemandMode mode);

/// Times are of every timed frame, counts of the last one.
struct DemandFigures {
    Spread frame_us;                 // time from its start until the device has finished it
    Spread shadow_cpu_us;            // time of the shadow stages (FrameReport::shadow_cpu_us)
    double frame_ratio = 0.0;        // median over rounds of the ratio to the same frames without shadows
    std::uint32_t lights_given = 0;  // lights with at least one view
    std::uint32_t views = 0, views_drawn = 0;
    std::uint32_t draws = 0;   // draws of depth passes
    std::uint64_t bytes = 0;   // memory of all lights
    std::uint32_t passes = 0;  // passes of the frame
};

struct DemandRow {
    std::uint32_t lights = 0, shadowed = 0;
    std::uint32_t programs_without = 0, programs = 0;  // distinct ones used without shadows; with and without
    std::array<std::array<DemandFigures, kDemandModes.size()>, kDemandMotions.size()> figures;
    const DemandFigures& of(DemandMotion motion, DemandMode mode) const {
        return figures[static_cast<std::size_t>(motion)][static_cast<std::size_t>(mode)];
    }
};

struct DemandOptions {
    std::vector<std::uint32_t> lights{1, 3, 10, 30, 100, 300, 1000};
    std::uint32_t rounds = 2, frames = 5;
    glm::uvec2 size_px{320, 180};
    std::vector<std::string> settings;  // KEY=VALUE, for every light with a shadow
};

struct Demand {
    std::string device;
    glm::uvec2 size_px{0, 0};
    std::uint32_t rounds = 0, frames = 0;
    std::vector<DemandRow> rows;
};

/// Measures a stage per number of lights. In each, for each motion, the modes take turns in `rounds` rounds, so that a
/// machine that slows down slows all. Errors: those of Stage::open.
Result<Demand> measure_demand(const DemandOptions& options);

/// Returns the machine and the subject of the measurement, and a table per motion.
std::string demand_markdown(const Demand& demand);
std::string demand_json(const Demand& demand);
/// Plots frame times, times of the stages, draws and bytes over the number of lights, as SVG. Both axes are
/// logarithmic.
std::string demand_plot(const Demand& demand);

}  // namespace gnomon::bench
