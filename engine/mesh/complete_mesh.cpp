#include "engine/math/aabb.h"
#include "engine/mesh/inner_box.h"
#include "engine/mesh/mesh_shape.h"
#include "engine/mesh/mesh_topology.h"
#include "gnomon/assets.h"

namespace gnomon::assets {

void complete(Mesh& mesh) {
    mesh.bounds_ms = {};
    for (const std::uint32_t vertex : mesh.indices)
        mesh.bounds_ms = math::extended(mesh.bounds_ms, glm::dvec3(mesh.vertices[vertex].position_ms));
    mesh.topology = analyse_topology(mesh);
    mesh.shape = shape_of(mesh);
    mesh.inner_ms = inner_box(mesh);
}

}  // namespace gnomon::assets
