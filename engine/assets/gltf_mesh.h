#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "engine/assets/gltf_materials.h"
#include "gnomon/assets.h"

namespace gnomon::assets::gltf {

/// Transform from a loaded mesh to the space of its file: file = middle + scale * loaded. Files with coordinates beyond
/// kMaxPosition_ms are moved and scaled by a power of two, which loses no bits of a float.
struct MeshPlace {
    glm::dvec3 middle_m{0.0};
    double scale = 1.0;
    bool operator==(const MeshPlace&) const = default;
};

/// Moves and scales the triangles' vertices so that none is beyond kMaxPosition_ms; sets unused vertices to 0 then.
/// Does nothing if none is beyond.
MeshPlace near_origin(Mesh& mesh);

/// Fills scene.meshes: one per glTF mesh, one submesh per primitive with triangles. Drops points, lines and triangles
/// with a non-finite corner, with a warning. Fills in missing normals, recomputes bounds, analyses topology. Returns
/// the place of each mesh.
std::vector<MeshPlace> load_meshes(Document& document, const std::vector<UvSource>& uv_sources, SceneData& scene);

}  // namespace gnomon::assets::gltf
