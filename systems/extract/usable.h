#pragma once
#include "gnomon/components.h"
#include "gnomon/light.h"

namespace gnomon {

/// Returns true if the light's numbers have a meaning: finite, and within the ranges that Light states. Sizes of
/// sources are cut to their ranges later and do not count.
bool usable(const Light& light);

/// Returns true if the fog's numbers have a meaning, within the ranges that FogVolume states.
bool usable(const FogVolume& fog);

/// Returns true if the camera's numbers have a meaning, within the ranges that Camera states.
bool usable(const Camera& camera);

}  // namespace gnomon
