#pragma once
#include "engine/mesh/mesh_topology.h"

namespace gnomon::assets {

/// Finds the parts of a surface by OpenMesh's connectivity: how loaded meshes are analysed.
SurfaceParts openmesh_parts(const std::vector<WeldedFace>& faces, const EdgePairing& pairing);

}  // namespace gnomon::assets
