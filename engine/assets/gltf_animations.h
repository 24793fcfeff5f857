#pragma once
#include <cstdint>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "engine/assets/scene_data.h"

namespace gnomon::assets::gltf {

/// Fills scene.animations, one per glTF animation, in order. Needs nodes with their skins; `scene_nodes` as
/// load_nodes() gave them. A channel that moves nothing of the scene is left out; so is one that says nothing usable
/// (keys that go back in time, values of another type or number, a rotation of length 0), with a warning: what does not
/// move is still there.
void load_animations(Document& document, const std::vector<std::int32_t>& scene_nodes, SceneData& scene);

}  // namespace gnomon::assets::gltf
