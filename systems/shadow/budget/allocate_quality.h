#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "systems/shadow/budget/cost_model.h"
#include "systems/shadow/frame/quality_limits.h"

/// Who is given less when shadows take more than they may. Pure: the same lights, in any order, are given the same.
namespace gnomon::shadow {

/// What all lights together may take; kNone: any amount.
struct BudgetLimits {
    static constexpr std::uint64_t kNone = ~std::uint64_t{0};
    std::uint64_t bytes = kNone, ns = kNone;
    bool operator==(const BudgetLimits&) const = default;
};
BudgetLimits limits_of(const ShadowBudget& budget);

struct BudgetUse {
    std::uint64_t bytes = 0, ns = 0;
    double harm = 0.0;
};
inline bool holds(const BudgetLimits& limits, const BudgetUse& use) {
    return use.bytes <= limits.bytes && use.ns <= limits.ns;
}

/// Reused storage; holds nothing between two calls.
struct BudgetScratch {
    struct Step {
        double price = 0.0;  // harm for each share of the budget that it frees, or takes
        std::uint32_t load = 0;
        Grant grant;
        Cost cost;
    };
    std::vector<Step> steps;
    std::vector<Cost> costs;    // one per load
    std::vector<Grant> start;   // one per load: what it may be given back at most
    std::vector<Grant> lastly;  // one per load: what it had before it was left nothing
    std::vector<Grant> fresh;
};

BudgetUse use_of(std::span<const LightLoad> loads, std::span<const Grant> grants, const CostFactors& factors);

/// Takes from `grants`, one per load, until `limits` hold: each time the step of least harm for what it frees (half the
/// edge, a cascade, the filter, half the refresh rate, all), then gives back what there was no need to take, that of
/// most harm for what it takes first. Nobody is given more than before.
BudgetUse take_away(std::span<const LightLoad> loads, const BudgetLimits& limits, const CostFactors& factors,
                    std::span<Grant> grants, BudgetScratch& scratch);

/// How long nothing is given back after any light was given less or more: a third of a second at 60 Hz, so that what is
/// shared out anew, and once more when the new maps have said what they cost, is settled within a second.
inline constexpr std::uint32_t kCalmFrames = 20;
/// What is given back has to leave so much of a budget free, so that a small change does not take it away again.
inline constexpr double kRoomAfter = 0.9;
/// Where one light is given more and another less, the picture has to gain so much more than it loses.
inline constexpr double kLeastGain = 1.25;

/// One frame onward: takes away what does not fit, at once; else, after kCalmFrames, gives back what then leaves room,
/// or shares out anew where that gains enough. `calm_frames`: since grants changed, at most kCalmFrames.
BudgetUse settle_grants(std::span<const LightLoad> loads, const BudgetLimits& limits, const CostFactors& factors,
                        std::uint32_t& calm_frames, std::span<Grant> grants, BudgetScratch& scratch);

}  // namespace gnomon::shadow
