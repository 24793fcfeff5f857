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
#include "systems/shadow/frame/tint_assignment.h"
#include "systems/shadow/frame/update_plan.h"

namespace gnomon::shadow {

/// Data of one frame between snapshot and commands, in the order of the stages. One stage writes each member, and no
/// member changes after that stage. All stages add to `statuses` and `cpu_us`. The fits write `next_history`; the
/// budget writes its BudgetHistory, frames_since_grants and short_of_bytes. Storage is reused from frame to frame. Only
/// ShadowSystem sees the whole.
struct ShadowFrame {
    std::vector<std::uint64_t> moving;    // bits of dynamic instances, as DynamicCasters::moving(); empty: none
    std::vector<LightStatus> statuses;    // one per light
    std::vector<ShadowRequest> requests;  // one per light: its request
    std::vector<ShadowRequest> limited;   // one per light: the same within the limits of its last grant
    std::vector<glm::dvec3> lamps_ws_m;   // one per light: apex of a local light's views
    ReceiverCasterSets sets;
    FittedViews fitted;
    std::vector<BudgetDecision> decisions;  // one per light
    std::vector<MapAssignment> maps;        // one per view
    std::vector<UpdatePlan> updates;        // one per view
    std::vector<TintAssignment> tints;      // one per view; empty: no view has translucent casters
    std::vector<std::uint8_t> ray_tints;    // one per light: 1: its rays meet translucent casters; empty: no light's do
    std::vector<double> clearances_m;       // one per light: nearest caster of an area light that no map contains
    std::vector<LightingInputs> inputs;     // one per camera view
    History next_history;                   // history of fits and budget for the next frame
    std::vector<double> cpu_us;             // one per light: time that the stages spent on it alone
};

/// Returns the frame's views with their maps.
inline DrawnViews drawn_views(const ShadowFrame& frame) {
    return {frame.fitted, frame.decisions, frame.maps, frame.updates, frame.statuses};
}

}  // namespace gnomon::shadow
