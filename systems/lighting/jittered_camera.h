#pragma once
#include <glm/vec2.hpp>

#include "engine/math/frustum.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::lighting {

/// Returns the camera with its picture moved by less than a pixel: each pixel shows what lies `jitter_px` from its
/// middle. Where surfaces are, and what shadows they have, stays.
shadow::CameraRecord jittered(const shadow::CameraRecord& camera, const glm::dvec2& jitter_px);

/// Computes the view volume that contains all that samples of any jitter see: a pixel beyond each edge of the picture.
math::Frustum jittered_frustum(const ConsumerItem& consumer);

}  // namespace gnomon::lighting
