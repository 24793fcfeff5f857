#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/assets.h"
#include "systems/extract/snapshot.h"

namespace gnomon::oracle {

/// Computes where each vertex of the mesh is, in the space of its instances: bent as in the snapshot, else at rest.
/// Works in double and never rounds to float. Independent of the project's own deformation: point by point after glTF
/// 2.0, 3.7.3.3.
std::vector<glm::dvec3> posed_positions(const SceneSnapshot& snapshot, const assets::MeshLibrary& library,
                                        std::uint32_t mesh);

}  // namespace gnomon::oracle
