#pragma once
#include <cstdint>

#include "systems/shadow/frame/shadow_request.h"

namespace gnomon::shadow {

/// What a budget left of one light's request. Without a budget: all of it.
struct BudgetDecision {
    ShadowRequest request;             // as fitted, then cut; the settings that all later stages read
    std::uint32_t refresh_frames = 1;  // a view with moved casters alone is drawn in one frame of this many
    bool over_budget = false;          // less is left than the light asked for
    double weight = 0.0;               // what its shadow means to the picture, 0 to 1
};

}  // namespace gnomon::shadow
