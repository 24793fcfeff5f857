#pragma once
#include <cstdint>
#include <string_view>

#include "gnomon/assets.h"
#include "gnomon/result.h"
#include "gnomon/shadows.h"

namespace gnomon::embed {

/// Materials of a library for meshes: these two, and one for each mask.
inline constexpr std::uint32_t kOneSided = 0, kTwoSided = 1;

/// Returns a library with those two materials and no mesh.
assets::MeshLibrary empty_library();

/// Adds a mesh to the library, and before it the material and the texture of its mask. Returns its index. Errors as
/// Shadows::add_mesh().
Result<std::uint32_t> add_mesh(const MeshDesc& desc, assets::MeshLibrary& library);

/// Adds a mesh without triangles of its own.
std::uint32_t add_box(std::string_view name, const Bounds& bounds_ms, assets::MeshLibrary& library);
/// Gives such a mesh other bounds and another version.
void change_box(std::uint32_t mesh, const Bounds& bounds_ms, assets::MeshLibrary& library);

/// Removes a mesh that these added, and what it added for it.
void remove_mesh(std::uint32_t mesh, assets::MeshLibrary& library);

}  // namespace gnomon::embed
