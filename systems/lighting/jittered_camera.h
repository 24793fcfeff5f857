#pragma once
#include <glm/vec2.hpp>

#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::lighting {

/// Returns the camera with its picture moved by less than a pixel: each pixel shows what lies `jitter_px` from its
/// middle. Where surfaces are, and what shadows they have, stays.
shadow::CameraRecord jittered(const shadow::CameraRecord& camera, const glm::dvec2& jitter_px);

}  // namespace gnomon::lighting
