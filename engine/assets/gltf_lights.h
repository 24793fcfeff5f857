#pragma once
#include "engine/assets/gltf_document.h"
#include "engine/assets/scene_data.h"

namespace gnomon::assets::gltf {

/// Fills scene.lights from KHR_lights_punctual, one each, in order. Throws Failure on values that make no light.
void load_lights(Document& document, SceneData& scene);

/// Fills scene.cameras, one each, in order. Throws Failure on values that make no camera.
void load_cameras(const Document& document, SceneData& scene);

}  // namespace gnomon::assets::gltf
