#pragma once
#include <cstdint>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "engine/assets/scene_data.h"

namespace gnomon::assets::gltf {

/// Fills scene.skins, and the nodes' skin and morph_weights, and sees to it that each mesh that bends is placed by one
/// node alone: further nodes get copies; a mesh with joints on a node without a skin becomes a still one. Needs nodes;
/// `scene_nodes` as load_nodes() gave them. Throws Failure on a skin that makes no pose: joints that it does not have,
/// matrices that are too few or of another type.
void load_skins(Document& document, const std::vector<std::int32_t>& scene_nodes, SceneData& scene);

}  // namespace gnomon::assets::gltf
