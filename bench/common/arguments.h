#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/check/check_command.h"
#include "bench/common/stage.h"
#include "bench/cost_model/calibrate.h"
#include "bench/draws/draw_costs.h"
#include "bench/embed/embed_costs.h"
#include "bench/flicker/edge_flicker.h"
#include "bench/flicker/flicker.h"
#include "bench/queries/queries.h"
#include "bench/scaling/light_count.h"

namespace CLI {
class App;
}

namespace gnomon::bench {

/// Arguments of all commands; each command reads its own.

struct Arguments {
    StageOptions stage;
    std::vector<std::string> scenes, against, visibility;
    std::string camera, size = "1280x720", demand_size = "320x180", offset, json, pictures, filter;
    std::uint32_t repeat = 9, rounds = 5, area_side = 0, noise_rounds = 1;
    StabilityOptions stability;
    double step_px = EdgeFlickerOptions{}.step_px;
    std::string plot, drawings, filters, rows, markdown;
    DemandOptions demand;
    SpeedOptions speeds;
    DrawCostOptions draws;
    QueriesOptions queries;
    EmbedOptions embed;
    CheckCommand check;
    std::string sweep, sweep_rows;
    bool quick = false, audit = false, beside = false;
    std::string out = "gnomon_sweep";
    bool rounds_given = false, repeat_given = false, size_given = false, lights_given = false,
         frames_given = false, points_given = false;
};

/// A command's options.
using AddOptions = void(CLI::App& command, Arguments& arguments);
AddOptions add_accuracy, add_audit, add_frame, add_stability, add_drawings, add_filters, add_culling, add_demand,
    add_budget, add_redraws, add_common, add_queries, add_check, add_embed, add_pictures, add_judge, add_edges,
    add_draws;

/// Derives the arguments that follow from given ones. Errors: "scene", "size", "offset", "mist", "time".
std::optional<Error> complete(Arguments& arguments);

}  // namespace gnomon::bench
