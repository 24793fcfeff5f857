#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "systems/extract/snapshot.h"

namespace gnomon::shadow {

/// Returns a lower bound on the view depth, metres, of all receivers on any of `layers` in the camera's frustum.
/// Infinite: there are none. Uses scene.shapes, or the instance's bounding box where its mesh has no shape. `scratch`
/// is overwritten.
double nearest_receiver_m(const SceneSnapshot& scene, const ConsumerItem& consumer, ShadowLayers layers,
                          std::vector<glm::dvec3>& scratch);

}  // namespace gnomon::shadow
