#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// Counts the frames of is_static() for lights that use rays. Runs after the fits. `budget_active`: a budget is active,
/// so that no light grows by itself.
void count_static_frames(const SceneSnapshot& scene, const FittedViews& fitted, const History& previous,
                         bool budget_active, History& next);

}  // namespace gnomon::shadow
