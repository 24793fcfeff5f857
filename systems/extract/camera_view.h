#pragma once
#include "gnomon/components.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// Sets the consumer's vertical extent: the camera's own, or larger if its frame is wider than the picture.
void fit_frame(const Camera& camera, ConsumerItem& consumer);

/// Sets the consumer's position, orientation and range. An orthographic view that starts behind its camera is moved
/// back to its start, so that no distance is negative.
void place_camera(const Camera& camera, const WorldTransform& world, ConsumerItem& consumer);

/// Sets the range alone, with the same rule.
void set_range(const Camera& camera, ConsumerItem& consumer);

/// Extracts the orientation of a light or camera: columns right, up, back; orthonormal. Scale and shear are ignored.
glm::dmat3 orientation(const glm::dmat3& basis);

}  // namespace gnomon
