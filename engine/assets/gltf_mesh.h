#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "engine/assets/gltf_materials.h"
#include "engine/assets/scene_data.h"

namespace gnomon::assets::gltf {

/// Where a mesh lies in the space that its file gave it: there = middle + scale * here. Files with coordinates beyond
/// kMaxPosition_ms are moved and scaled by a power of two, so that floats hold all that they held.
struct MeshPlace {
    glm::dvec3 middle_m{0.0};
    double scale = 1.0;
    bool operator==(const MeshPlace&) const = default;
};

/// Moves and scales the vertices that triangles use so that none is beyond kMaxPosition_ms; sets the others to 0 then.
/// Nothing is done if none is.
MeshPlace near_origin(Mesh& mesh);

/// Fills scene.meshes: one per glTF mesh, one submesh per primitive that has triangles. Points and lines are left out
/// with a warning, as are triangles with a corner that is no number. Normals that the file lacks are filled, bounds
/// recomputed, topology analysed. Returns the place of each.
std::vector<MeshPlace> load_meshes(Document& document, const std::vector<UvSource>& uv_sources, SceneData& scene);

}  // namespace gnomon::assets::gltf
