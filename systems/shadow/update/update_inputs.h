#pragma once
#include <span>

#include "systems/shadow/budget/apply_budget.h"
#include "systems/shadow/frame/budget_decision.h"
#include "systems/shadow/frame/map_assignment.h"
#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/frame/update_plan.h"

namespace gnomon::shadow {

/// Inputs of the updates of maps, beside the scene and what layers show.
struct UpdateInputs {
    const FittedViews& fitted;
    std::span<const BudgetDecision> decisions;  // one per light
    std::span<const MapAssignment> maps;        // one per view
    DrawAllowance allowance;
};

}  // namespace gnomon::shadow
