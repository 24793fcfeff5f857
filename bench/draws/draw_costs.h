#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bench/common/median_range.h"
#include "gnomon/result.h"

/// What depth passes of many meshes cost the processor: a command per draw, and one for all with the same state.
namespace gnomon::bench {

struct DrawCostOptions {
    std::uint32_t casters = 10000;  // each a mesh of its own
    std::uint32_t views = 8;        // each shows all casters
    std::uint32_t frames = 15;      // timed frames per row; their median counts
};

/// One kind of map, drawn in one way. Times are of all views, microseconds.
struct DrawCost {
    const char* maps = "";
    bool multi_draw = false;
    std::uint64_t draws = 0, commands = 0;  // in one frame
    std::uint64_t upload_bytes = 0;         // that the passes upload in one frame
    Spread record_us;                       // stages before the device: gathering, recording
    Spread submit_us;                       // submission of the same commands with no instance in any draw
    Spread drawn_us;                        // submission of them all, until the device has finished
};

struct DrawCosts {
    std::string device;
    DrawCostOptions options;
    std::vector<DrawCost> rows;
};

/// Measures on a headless context. Errors: those of the context and the device; "bench.frame".
Result<DrawCosts> measure_draw_costs(const DrawCostOptions& options);

std::string draw_costs_markdown(const DrawCosts& costs);
std::string draw_costs_json(const DrawCosts& costs);

}  // namespace gnomon::bench
