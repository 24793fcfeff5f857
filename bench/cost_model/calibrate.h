#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>

#include "bench/common/median_range.h"
#include "gnomon/result.h"

/// Speed of the device at hand for the kinds of work in the budgets' model (systems/shadow/budget/cost_model.h).
namespace gnomon::bench {

struct SpeedOptions {
    glm::uvec2 size_px{640, 360};
    std::uint32_t frames = 5;  // frames per row and round; their median counts
    std::uint32_t rounds = 9;
};

/// One kind of work: what the model takes it to cost, and what it was found to, over the rounds. Both nanoseconds.
struct Speed {
    const char* work = "";
    double model_ns = 0.0;
    Spread measured_ns;
};

struct BudgetSpeeds {
    std::string device;
    std::array<Speed, 6> speeds;
    /// How far rows are from what the figures of their round make of them, at worst, as a share: the median round's.
    double drawing_residual = 0.0, lighting_residual = 0.0;
};

/// Measures the time per unit of each kind of work. Rows that differ in one kind each take turns, round by round. Least
/// squares over a round's times, relative to each row's time, yield the units. Errors: those of the stage.
Result<BudgetSpeeds> measure_budget_speeds(const SpeedOptions& options);

std::string budget_speeds_markdown(const BudgetSpeeds& speeds);

}  // namespace gnomon::bench
