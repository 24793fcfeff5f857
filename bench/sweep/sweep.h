#pragma once
#include <functional>
#include <string>
#include <vector>

#include "bench/common/stage.h"
#include "bench/compare/evaluate_configuration.h"
#include "bench/sweep/sweep_plan.h"

namespace gnomon::bench {

struct SweepOptions {
    SweepSize size = SweepSize::full;
    std::filesystem::path folder;  // for the journal and pictures; it exists
    std::uint32_t rounds = 5;      // most rounds of times; 0: none
    std::uint32_t frames = 0;      // timed frames of each kind per row and round; 0: by the device
    double budget_s = 1080.0;      // nothing is timed later, except the first round
    bool disks = true;             // soft shadows as well
    std::uint32_t area_side = 0;   // TruthOptions::area_side
    std::function<void(const std::string& line)> progress = [](const std::string&) {};
    std::vector<SweepRow> plan = {};  // empty: sweep_plan()
    std::string only = {};            // regular expression: only the defaults and rows that match; empty: all
};

/// Rows of one scene. Each has a SweepRow, its settings, and a JudgedRow, its result.
struct SceneSweep {
    std::string scene, device, camera;
    glm::uvec2 size_px{0, 0};
    double trace_s = 0.0, spent_s = 0.0;  // spent: interrupted runs that this one went on from included
    std::uint32_t rounds = 0;             // rounds of times that every row has
    std::uint32_t gl_complaints = 0;
    std::vector<SweepRow> plan;
    std::vector<JudgedRow> rows;  // in the plan's order
};

/// Judges every row of the plan by truths that are traced once, then times them all in rounds. In each round every few
/// rows share a block of the defaults right before them. Their times are divided by that block's, so that a machine
/// that slows down slows both. The journal supplies the results of an interrupted run with the same plan, scene and
/// device. Rows that fail are in the result with their error. Errors: "bench.camera", "output.write", "output.folder",
/// "rows.regex".
Result<SceneSweep> measure_sweep(Stage& stage, const SweepOptions& options);

}  // namespace gnomon::bench
