#pragma once
#include <cstdint>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "engine/assets/scene_data.h"

namespace gnomon::assets::gltf {

/// Fills scene.lights from KHR_lights_punctual, one each, in order. Values that make no light are taken as the nearest
/// that do, with a warning; numbers beyond a float throw Failure.
void load_lights(Document& document, SceneData& scene);

/// Fills scene.cameras, in order, but for those whose values make no camera: these are left out, with a warning.
/// Returns which of scene.cameras each glTF camera became; kNone for those left out.
std::vector<std::int32_t> load_cameras(Document& document, SceneData& scene);

}  // namespace gnomon::assets::gltf
