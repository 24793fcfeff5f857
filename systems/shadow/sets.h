#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/types.h"

namespace gnomon::shadow {

/// Stage 3: for each demand that is not skipped, the receivers that a consumer sees and the light reaches (PSR), with
/// the corner points of what is seen of them, and the casters that can darken them (PSC), whether a camera sees those
/// or not. Fills frame.sets, receiver_items, caster_items, receiver_points_ws. Conservative: bounds stand for meshes.
void select_sets(const SceneSnapshot& scene, ShadowFrame& frame);

}  // namespace gnomon::shadow
