#pragma once
#include <cstddef>
#include <span>

#include "systems/shadow/frame/budget_decision.h"
#include "systems/shadow/frame/light_status.h"
#include "systems/shadow/frame/map_assignment.h"
#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/frame/update_plan.h"

namespace gnomon::shadow {

/// Views of a frame with their maps, for the passes, publishing and the report. `v`: index of a view.
struct DrawnViews {
    const FittedViews& fitted;
    std::span<const BudgetDecision> lights;  // one per light
    std::span<const MapAssignment> maps;     // one per view
    std::span<const UpdatePlan> updates;     // one per view
    std::span<const LightStatus> statuses;   // one per light

    std::size_t count() const { return fitted.views.size(); }
    const ShadowView& view(std::size_t v) const { return fitted.views[v]; }
    const ShadowRequest& request_of(std::size_t v) const { return lights[view(v).light].request; }

    /// Returns true if the view has a map in this frame, drawn or reused.
    bool has_map(std::size_t v) const {
        return maps[v].texture && !updates[v].skipped_for_rays && !statuses[view(v).light].has_lost_maps();
    }
    bool is_drawn(std::size_t v) const { return has_map(v) && !updates[v].reuse; }
    bool has_prefiltered(std::size_t v) const {
        return has_map(v) && maps[v].prefiltered.moments && !statuses[view(v).light].has_lost_prefiltered();
    }
};

}  // namespace gnomon::shadow
