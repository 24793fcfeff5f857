#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "systems/shadow/frame/budget_decision.h"
#include "systems/shadow/frame/drawn_views.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/frame/light_status.h"
#include "systems/shadow/frame/lighting_inputs.h"
#include "systems/shadow/frame/map_assignment.h"
#include "systems/shadow/frame/receiver_caster_sets.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/frame/update_plan.h"

namespace gnomon::shadow {

/// Everything of one frame between snapshot and commands, in the order in which it comes to be. Each member has one
/// stage that writes it, and none changes after that stage; LightStatus alone is added to by all. Storage is reused
/// from frame to frame. Only ShadowSystem sees the whole.
struct ShadowFrame {
    std::vector<std::uint64_t> moving;    // bits of instances that move, as CasterMotion::moving(); empty: none
    std::vector<LightStatus> statuses;    // one per light
    std::vector<ShadowRequest> requests;  // one per light: what it asks for
    std::vector<ShadowRequest> limited;   // one per light: what its last grant leaves of that
    std::vector<glm::dvec3> lamps_ws_m;   // one per light: from where a local light's shadows are looked for
    ReceiverCasterSets sets;
    FittedViews fitted;
    std::vector<BudgetDecision> decisions;  // one per light
    std::vector<MapAssignment> maps;        // one per view
    std::vector<UpdatePlan> updates;        // one per view
    std::vector<double> clearances_m;       // one per light: nearest caster of a lamp with a size that no map holds
    std::vector<LightingInputs> inputs;     // one per consumer
    History next_history;                   // what the fits and the budget hand to the next frame
    std::vector<double> cpu_us;             // one per light: what the stages spent on it alone
};

/// Returns the frame's views with their maps.
inline DrawnViews drawn_views(const ShadowFrame& frame) {
    return {frame.fitted, frame.decisions, frame.maps, frame.updates, frame.statuses};
}

}  // namespace gnomon::shadow
