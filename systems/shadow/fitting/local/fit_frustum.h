#pragma once
#include <vector>

#include "systems/shadow/projection/light_frusta.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {

/// Appends a local light's view through a light frustum that contains both a receiver and a caster. Crops it to what is
/// seen of the receivers. Depth reaches from the nearest caster or receiver to the farthest receiver. Both are kept by
/// hysteresis (fit_hysteresis.h), so that a map stays valid while the camera walks. Returns false if the range is
/// empty.
bool fit_frustum(const FitInput& input, const LightFrustum& frustum, const ReceiverHull& receiver_hull,
                 std::vector<ShadowView>& views);

}  // namespace gnomon::shadow
