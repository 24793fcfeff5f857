#pragma once
#include "components/shadow_tuning.h"
#include "systems/shadow/frame/shadow_frame.h"
#include "systems/shadow/projection/perspective_range.h"

/// ShadowTuning's near_m and far_m against the fitted depth range. Distances are from the light, or from a sun's eye.
namespace gnomon::shadow {

/// Whether they can be obeyed: each 0 (fitted) or positive and finite, near before far where both are given.
bool is_range(const ShadowTuning::Projection& tuning);

/// Puts the ends that the request asks for in the place of fitted ones. A fitted end that a given one has passed moves
/// out of its way, to half or twice the given distance. Afterwards near_m < far_m if that held before.
void override_range(const ProjectionRequest& projection, double& near_m, double& far_m);

/// The same for a perspective view; its near never falls below far * kLeastNear. A range without a volume stays one.
PerspectiveRange overridden(const ProjectionRequest& projection, PerspectiveRange fitted);

}  // namespace gnomon::shadow
