#pragma once
#include <cstdint>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "gnomon/assets.h"

namespace gnomon::assets::gltf {

/// Fills scene.animations, one per glTF animation, in order. Needs nodes with their skins, and `scene_nodes` from
/// load_nodes(). Drops channels without effect on the scene. Drops unusable channels with a warning, so that the rest
/// of the scene remains. Unusable are decreasing times, values of wrong type or number, and rotations of length 0.
void load_animations(Document& document, const std::vector<std::int32_t>& scene_nodes, SceneData& scene);

}  // namespace gnomon::assets::gltf
