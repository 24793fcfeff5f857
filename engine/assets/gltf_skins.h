#pragma once
#include <cstdint>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "gnomon/assets.h"

namespace gnomon::assets::gltf {

/// Fills scene.skins, and the nodes' skin and morph_weights. Needs nodes, and `scene_nodes` from load_nodes().
/// Afterwards exactly one node uses each deformable mesh: further nodes get copies. A mesh with joints on a node
/// without a skin becomes rigid. Throws Failure on invalid skins: missing joints, too few matrices, matrices of another
/// type.
void load_skins(Document& document, const std::vector<std::int32_t>& scene_nodes, SceneData& scene);

}  // namespace gnomon::assets::gltf
