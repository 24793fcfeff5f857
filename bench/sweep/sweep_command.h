#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "bench/common/stage.h"
#include "bench/sweep/sweep.h"

namespace gnomon::bench {

struct SweepCommand {
    SweepSize size = SweepSize::full;
    StageOptions stage;
    std::vector<std::filesystem::path> scenes;  // empty: the built-in one
    std::filesystem::path folder = "gnomon_sweep";
    std::string only;  // as SweepOptions::only
    std::optional<std::uint32_t> rounds;
    std::uint32_t frames = 0;     // 0: by the device
    std::uint32_t area_side = 0;  // as SweepOptions::area_side
};

/// Sweeps each scene in turn, reports its progress on stderr, and writes report.json into the folder. report.py makes
/// the page and the tables of it. Errors: those of Stage::open, measure_sweep and game::write_file.
std::optional<Error> run_sweep(const SweepCommand& command);

}  // namespace gnomon::bench
