#pragma once
#include <vector>

#include "engine/assets/gltf_document.h"
#include "engine/assets/gltf_materials.h"
#include "engine/assets/scene_data.h"

namespace gnomon::assets::gltf {

/// Fills scene.meshes: one per glTF mesh, one submesh per primitive that has triangles. Points and lines are left out
/// with a warning. Normals that the file lacks are filled, bounds recomputed, topology analysed.
void load_meshes(Document& document, const std::vector<UvSource>& uv_sources, SceneData& scene);

}  // namespace gnomon::assets::gltf
