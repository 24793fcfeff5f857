#pragma once
#include <cstdint>
#include <glm/mat3x2.hpp>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "engine/assets/scene_data.h"

namespace gnomon::assets::gltf {

/// What a material demands of the vertices that wear it.
struct UvSource {
    int set = 0;                  // TEXCOORD_<set>
    bool wanted = false;          // there is a texture that reads it
    glm::mat3x2 transform{1.0f};  // KHR_texture_transform, applied at load
};

/// Fills scene.materials (one per glTF material, in order, then a default one if there is none) and scene.textures
/// (those that a base colour uses). A texture that cannot be had is a warning; a masked material without it becomes
/// opaque. Returns one entry per glTF material.
std::vector<UvSource> load_materials(Document& document, SceneData& scene);

/// One warning that names the blended materials of whatever is placed to cast a shadow: nothing blended casts one.
void warn_of_blended_casters(Document& document, const SceneData& scene);

}  // namespace gnomon::assets::gltf
