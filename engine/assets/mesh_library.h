#pragma once
#include <vector>

#include "engine/assets/scene_data.h"

namespace gnomon::assets {

/// The meshes, materials and textures that MeshRef components name. Fixed once handed to a GpuScene.
struct MeshLibrary {
    std::vector<Mesh> meshes;
    std::vector<Material> materials;  // Submesh::material indexes this
    std::vector<Texture> textures;
};

}  // namespace gnomon::assets
