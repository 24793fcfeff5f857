#pragma once
#include "components/camera.h"
#include "components/transform.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// The camera's height in the consumer's picture: its own, grown where the frame it was given would be wider than that.
void fit_frame(const Camera& camera, ConsumerItem& consumer);

/// Where the consumer stands, where it looks, and how far. A flat view that begins behind its camera is the same from
/// there on back: it is moved to where it begins, so that no distance is negative.
void place_camera(const Camera& camera, const WorldTransform& world, ConsumerItem& consumer);

/// As place_camera() leaves them.
void set_range(const Camera& camera, ConsumerItem& consumer);

/// Direction only: a light's or camera's scale and shear do not count. Columns right, up, back; orthonormal.
glm::dmat3 orientation(const glm::dmat3& basis);

}  // namespace gnomon
