#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "systems/shadow/budget/cost_model.h"
#include "systems/shadow/frame/quality_limits.h"

/// Limits the quality of lights when shadows exceed a budget. Pure functions: equal lights, in any order, get equal
/// limits.
namespace gnomon::shadow {

/// Budget of all lights together; kNone: unlimited.
struct BudgetLimits {
    static constexpr std::uint64_t kNone = ~std::uint64_t{0};
    std::uint64_t bytes = kNone, ns = kNone;
    bool operator==(const BudgetLimits&) const = default;
};
/// Returns the limits that the budget names, without the automatic one (automatic_limit.h).
BudgetLimits limits_of(const ShadowBudget& budget);

struct BudgetUse {
    std::uint64_t bytes = 0, ns = 0;
    double harm = 0.0;
};
inline bool holds(const BudgetLimits& limits, const BudgetUse& use) {
    return use.bytes <= limits.bytes && use.ns <= limits.ns;
}

/// Reused storage; empty of meaning between two calls.
struct BudgetScratch {
    struct Step {
        double price = 0.0;  // error cost per share of the budget that the step frees, or uses
        std::uint32_t load = 0;
        QualityLimits grant;
        Cost cost;
    };
    std::vector<Step> steps;
    std::vector<Cost> costs;            // one per load
    std::vector<QualityLimits> start;   // one per load: limits up to which quality may be given back
    std::vector<QualityLimits> lastly;  // one per load: limits before its map was taken away
    std::vector<QualityLimits> fresh;
};

BudgetUse use_of(std::span<const LightLoad> loads, std::span<const QualityLimits> grants, const CostFactors& factors);

/// Lowers the quality of `grants`, one per load, until `limits` are met, by greedy steps. A step halves the edge,
/// removes a cascade, simplifies the filter, halves the refresh rate or removes the map. Each step has the least error
/// cost for what it frees. Then gives back what need not have been taken, the greatest error cost per share first. No
/// light gets more than at the start.
BudgetUse take_away(std::span<const LightLoad> loads, const BudgetLimits& limits, const CostFactors& factors,
                    std::span<QualityLimits> grants, BudgetScratch& scratch);

/// Frames without a change of any limit before quality is given back: a third of a second at 60 Hz. A new allocation,
/// and its correction once the new maps' costs are measured, is then settled within a second.
inline constexpr std::uint32_t kFramesToRegrant = 20;
/// Share of a budget up to which quality is given back. The rest stays free, so that a small change does not take it
/// away again.
inline constexpr double kRoomAfter = 0.9;
/// Ratio of gained to lost error cost that a new allocation needs, where one light gets more and another less.
inline constexpr double kLeastGain = 1.25;

/// Advances the limits by one frame. Takes away at once what does not fit. After kFramesToRegrant, computes the
/// allocation again within kRoomAfter of the budget, and adopts it if it gains enough. `frames_since_grants`: since the
/// limits changed, at most kFramesToRegrant.
BudgetUse settle_limits(std::span<const LightLoad> loads, const BudgetLimits& limits, const CostFactors& factors,
                        std::uint32_t& frames_since_grants, std::span<QualityLimits> grants, BudgetScratch& scratch);

}  // namespace gnomon::shadow
