#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "systems/extract/snapshot.h"

namespace gnomon::shadow {

/// View depth before which the consumer sees nothing that receives on any of `layers`: infinite if it sees nothing of
/// the kind at all. Conservative, by scene.shapes; where a mesh has none, by the instance's bounds. `scratch` is
/// overwritten.
double nearest_receiver_m(const SceneSnapshot& scene, const ConsumerItem& consumer, ShadowLayers layers,
                          std::vector<glm::dvec3>& scratch);

}  // namespace gnomon::shadow
