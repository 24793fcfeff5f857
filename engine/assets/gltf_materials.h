#pragma once
#include <cstdint>
#include <glm/mat3x2.hpp>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "gnomon/assets.h"

namespace gnomon::assets::gltf {

/// Texture coordinates that a material needs.
struct UvSource {
    int set = 0;                  // TEXCOORD_<set>
    bool wanted = false;          // a texture reads it
    glm::mat3x2 transform{1.0f};  // KHR_texture_transform, applied at load
};

/// Fills scene.materials: one per glTF material, in order, or a default one. Fills scene.textures with the textures of
/// base colours. A missing texture is a warning; a masked material without it becomes opaque. Returns one entry per
/// glTF material.
std::vector<UvSource> load_materials(Document& document, SceneData& scene);

/// Warns once of all blended materials on nodes that are to cast shadows, because blended materials cast none.
void warn_of_blended_casters(Document& document, const SceneData& scene);

}  // namespace gnomon::assets::gltf
