#pragma once
#include "engine/assets/mesh_library.h"
#include "engine/core/result.h"
#include "gnomon/shadows.h"

namespace gnomon::embed {

/// Materials of a library for meshes: these two, and one for each mask.
inline constexpr std::uint32_t kOneSided = 0, kTwoSided = 1;

/// Returns a library with those two materials and no mesh.
assets::MeshLibrary empty_library();

/// Makes a mesh of a description, and appends the material and the texture of its mask to the library. Errors as
/// Shadows::add_mesh().
Result<assets::Mesh> mesh_of(const MeshDesc& desc, assets::MeshLibrary& library);

}  // namespace gnomon::embed
