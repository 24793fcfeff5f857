#include "bench/sweep/sweep_command.h"

#include <algorithm>
#include <cstdio>
#include <span>

#include "bench/sweep/sweep_json.h"
#include "sample_game/support/files/image_files.h"

namespace gnomon::bench {
namespace {

// What remains of 2 and of 20 minutes is for loading, truth and the report.
constexpr double kQuickBudget_s = 85.0, kFullBudget_s = 1020.0;
constexpr std::uint32_t kRounds = 5;

Result<SceneSweep> sweep_scene(const SweepCommand& command, std::size_t index) {
    StageOptions stage_options = command.stage;
    if (!command.scenes.empty()) stage_options.scene = command.scenes[index];
    auto stage = Stage::open(stage_options);
    if (!stage) return stage.error();
    SweepOptions options;
    options.size = command.size;
    options.only = command.only;
    options.rounds = command.rounds.value_or(kRounds);
    options.frames = command.frames;
    options.area_side = command.area_side;
    options.budget_s = command.size == SweepSize::quick ? kQuickBudget_s : kFullBudget_s;
    options.folder = command.folder / ("scene_" + std::to_string(index));
    options.progress = [](const std::string& line) { std::fprintf(stderr, "gnomon_bench: %s\n", line.c_str()); };
    if (auto error = game::make_writable_folder(options.folder)) return *error;
    return measure_sweep(*stage.value(), options);
}

}  // namespace

std::optional<Error> run_sweep(const SweepCommand& command) {
    std::vector<SceneSweep> scenes;
    for (std::size_t i = 0; i < std::max<std::size_t>(command.scenes.size(), 1); ++i) {
        auto sweep = sweep_scene(command, i);
        if (!sweep) return sweep.error();
        scenes.push_back(std::move(sweep).value());
    }
    const std::string json = sweep_json(scenes);
    return game::write_file(command.folder / "report.json", std::as_bytes(std::span(json)));
}

}  // namespace gnomon::bench
