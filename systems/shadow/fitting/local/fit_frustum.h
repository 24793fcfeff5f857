#pragma once
#include <vector>

#include "systems/shadow/projection/light_frusta.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {

/// Appends a local light's view through an opening, if there are both a receiver and a caster: cropped to what is seen
/// of the receivers in it, its depth from the nearest caster or receiver to the farthest receiver. Both are in steps
/// that are held (fit_hysteresis.h), so that a map stays valid while the camera walks. False if the depth range is no
/// range.
bool fit_opening(const FitInput& input, const LightOpening& opening, const Beam& beam, std::vector<ShadowView>& views);

}  // namespace gnomon::shadow
