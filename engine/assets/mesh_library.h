#pragma once
#include <vector>

#include "engine/assets/scene_data.h"

namespace gnomon::assets {

/// Meshes, materials and textures that MeshRef components refer to. Fixed once a GpuScene has it.
struct MeshLibrary {
    std::vector<Mesh> meshes;
    std::vector<Material> materials;  // Submesh::material indexes this
    std::vector<Texture> textures;
};

}  // namespace gnomon::assets
