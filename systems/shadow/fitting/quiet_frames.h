#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// Counts the frames of is_quiet() for lights that use rays. Runs after the fits. `shared_out`: a budget is active, so
/// that no light grows by itself.
void count_quiet_frames(const SceneSnapshot& scene, const FittedViews& fitted, const History& held, bool shared_out,
                        History& next);

}  // namespace gnomon::shadow
