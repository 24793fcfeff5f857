#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "systems/extract/snapshot.h"

namespace gnomon::shadow {

/// Receivers to look for.
enum class ReceiverKinds : std::uint8_t { all, surfaces };

/// Returns a lower bound on the view depth, metres, of all receivers on any of `layers` in the camera's frustum.
/// Infinite: there are none. Uses the meshes' shapes, or the instance's bounding box where its mesh has no shape, as of
/// air. `scratch` is overwritten.
double nearest_receiver_m(const SceneSnapshot& scene, const ConsumerItem& consumer, ShadowLayers layers,
                          std::vector<glm::dvec3>& scratch, ReceiverKinds kinds = ReceiverKinds::all);

}  // namespace gnomon::shadow
