#pragma once
#include <optional>
#include <string>
#include <vector>

#include "bench/accuracy/default_limits.h"
#include "bench/sweep/sweep.h"

/// What a sweep says, light by light.
namespace gnomon::bench {

/// Which error a row is judged by: its share of wrong pixels, by the truth about a point, or its mean error, by that
/// about a disk. And which time it takes: with every view drawn, or with kept maps; as a share of the defaults'.
enum class SweepTruth : std::uint8_t { point, disk };
enum class SweepCost : std::uint8_t { drawn, kept };
inline constexpr SweepTruth kSweepTruths[] = {SweepTruth::point, SweepTruth::disk};
inline constexpr SweepCost kSweepCosts[] = {SweepCost::drawn, SweepCost::kept};
const char* to_text(SweepTruth truth);
const char* to_text(SweepCost cost);

/// A row of a light, of which both are known.
struct Choice {
    std::size_t row = 0;  // of SceneSweep::plan
    double error = 0.0, cost = 0.0;
    bool best = false;  // no other row has less error for no more cost (pareto_front.h)
};

/// Rows of one light, the cheapest first. The defaults cost 1.
std::vector<Choice> choices(const SceneSweep& sweep, const std::string& light, SweepTruth truth, SweepCost cost);

/// From one row of a front to the cheapest with at most half of its error.
struct Halving {
    Choice from, to;
    double error_factor() const;  // at most 1/2
    double cost_factor() const { return to.cost / from.cost; }
};

/// What halving the error costs one light.
struct HalvingCost {
    std::vector<Halving> steps;            // from the cheapest row on, one after the other
    std::optional<double> factor;          // that each halving multiplies the time by, over all steps together
    std::optional<Halving> from_defaults;  // if any row has half of their error
    std::optional<Choice> defaults;
};
/// An error of less than half a pixel of those that are scored counts as that.
HalvingCost halving_cost(const SceneSweep& sweep, const std::string& light, SweepTruth truth, SweepCost cost);

/// Of defaults that do not keep their promise (default_limits.h): what kept them from it, and what reaching it takes.
struct Missed {
    PromisedErrors errors;
    double beyond = 0.0, sub_texel = 0.0;  // places on edges farther off than predicted, and the narrow ones of them
    std::optional<Choice> reached;         // the cheapest row that keeps it; none: no row
};
/// Empty: the defaults keep it, or are not known.
std::optional<Missed> missed_by_defaults(const SceneSweep& sweep, const std::string& light, SweepCost cost);

/// What the defaults take, as multiples of the light's first tutorial, which draws its map in every frame.
struct BesideTutorial {
    Choice tutorial;
    double drawn = 0.0;          // the defaults draw theirs in every frame as well
    std::optional<double> kept;  // theirs are kept, as they are while nothing in them moves
};
std::optional<BesideTutorial> beside_tutorial(const SceneSweep& sweep, const std::string& light);

/// A tutorial's row, and the best that no more time buys.
struct Bargain {
    Choice tutorial, best;
};
std::vector<Bargain> bargains(const SceneSweep& sweep, const std::string& light, SweepCost cost);

/// Names of the lights that have rows, in the order of the first row.
std::vector<std::string> lights_of(const SceneSweep& sweep);
/// A light's row; null if the plan's row has none of it, or failed.
const LightRow* find_row(const SceneSweep& sweep, std::size_t row, const std::string& light);
/// Names of the plan's rows that are on no front of any light.
std::vector<std::string> never_best(const SceneSweep& sweep);

}  // namespace gnomon::bench
