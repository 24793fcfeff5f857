#include "ground_and_box.h"

#include <cstdint>
#include <glm/geometric.hpp>

namespace {

using gnomon::assets::Mesh;

void add_face(Mesh& mesh, const glm::vec3& middle, const glm::vec3& u, const glm::vec3& v) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
        mesh.vertices.push_back({middle + corner.x * u + corner.y * v, normal, 0.5f * corner + 0.5f});
    for (const std::uint32_t i : {0u, 1u, 2u, 2u, 3u, 0u}) mesh.indices.push_back(first + i);
    mesh.submeshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
}

}  // namespace

gnomon::assets::MeshLibrary ground_and_box() {
    gnomon::assets::MeshLibrary library;
    library.materials.resize(1);
    library.meshes.resize(2);
    add_face(library.meshes[kGroundMesh], {}, {0, 0, 4}, {4, 0, 0});
    const glm::vec3 x(0.5f, 0, 0), y(0, 0.5f, 0), z(0, 0, 0.5f);
    Mesh& box = library.meshes[kBoxMesh];
    add_face(box, x, y, z);
    add_face(box, -x, z, y);
    add_face(box, y, z, x);
    add_face(box, -y, x, z);
    add_face(box, z, x, y);
    add_face(box, -z, y, x);
    for (Mesh& mesh : library.meshes) gnomon::assets::complete(mesh);
    return library;
}
