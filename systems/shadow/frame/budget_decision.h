#pragma once
#include <cstdint>

#include "systems/shadow/frame/shadow_request.h"

namespace gnomon::shadow {

/// One light's request after the budget's limits. Without a budget: the whole request.
struct BudgetDecision {
    ShadowRequest request;             // request of the fit within the limits; all later stages read these settings
    std::uint32_t refresh_frames = 1;  // period of drawing a view in which only casters moved, frames
    bool over_budget = false;          // the budget reduced the request
    double weight = 0.0;               // importance of its shadow to the picture, 0 to 1
};

}  // namespace gnomon::shadow
