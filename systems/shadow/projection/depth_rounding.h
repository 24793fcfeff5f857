#pragma once
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// Returns the error of depth that is not proportional to it (bias/automatic.glsl adds the proportional part).
/// `reach_m`: distance of receivers from the anchor, if that is not the light.
double projection_rounding(const ShadowView& view, double reach_m);

}  // namespace gnomon::shadow
