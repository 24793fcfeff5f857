#pragma once
#include "gnomon/shadow_tuning.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/projection/perspective_range.h"

/// Replacement of the fitted depth range by ShadowTuning's near_m and far_m, metres from the light or from a sun's eye.
namespace gnomon::shadow {

/// Returns true if near_m and far_m are usable. Each must be 0 (fitted) or positive and finite, and near less than far
/// where both are given.
bool is_range(const ShadowTuning::Projection& tuning);

/// Replaces fitted ends by the request's, where these are above 0. A fitted end on the wrong side of a given one moves
/// to half or twice the given distance. near_m < far_m stays true if it was.
void override_range(const ProjectionRequest& projection, double& near_m, double& far_m);

/// Replaces the ends of a perspective view in the same way; near never falls below far * kLeastNear. Returns an empty
/// range (near >= far) unchanged.
PerspectiveRange overridden(const ProjectionRequest& projection, PerspectiveRange fitted);

}  // namespace gnomon::shadow
