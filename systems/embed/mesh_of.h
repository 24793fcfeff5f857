#pragma once
#include <cstdint>

#include "engine/assets/mesh_library.h"
#include "engine/core/result.h"
#include "gnomon/shadows.h"

namespace gnomon::embed {

/// Materials of a library for meshes: these two, and one for each mask.
inline constexpr std::uint32_t kOneSided = 0, kTwoSided = 1;

/// Returns a library with those two materials and no mesh.
assets::MeshLibrary empty_library();

/// Adds a mesh to the library, and before it the material and the texture of its mask. Returns its index. Errors as
/// Shadows::add_mesh().
Result<std::uint32_t> add_mesh(const MeshDesc& desc, assets::MeshLibrary& library);

/// Removes a mesh that add_mesh() added, and what it added for it.
void remove_mesh(std::uint32_t mesh, assets::MeshLibrary& library);

}  // namespace gnomon::embed
