#pragma once
#include <cstdint>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "gnomon/assets.h"

namespace gnomon::assets::gltf {

/// Fills scene.lights from KHR_lights_punctual and then EXT_lights_area, one each, in order. Invalid values become the
/// nearest valid ones, with a warning. Numbers beyond a float throw Failure.
void load_lights(Document& document, SceneData& scene);

/// Fills scene.cameras, in order. Drops invalid cameras with a warning. Returns for each glTF camera its index in
/// scene.cameras; kNone for dropped ones.
std::vector<std::int32_t> load_cameras(Document& document, SceneData& scene);

}  // namespace gnomon::assets::gltf
