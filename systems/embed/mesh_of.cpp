#include "systems/embed/mesh_of.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/math/aabb.h"
#include "engine/math/finite.h"
#include "engine/mesh/mesh_shape.h"
#include "engine/mesh/mesh_topology.h"

namespace gnomon::embed {
namespace {

Error mesh_error(const MeshDesc& desc, const char* what, const char* rule) {
    std::string name = desc.name.empty() ? "mesh" : "mesh " + std::string(desc.name);
    return {name + " " + what, {}, {}, rule};
}

bool has_mask(const AlphaMask& mask) { return mask.size_px.x > 0 && mask.size_px.y > 0; }

/// Returns whether the mesh lets any light through. Comparing so that NaN lets none.
bool is_translucent(const glm::vec3& transmittance) {
    return transmittance.x > 0.0f || transmittance.y > 0.0f || transmittance.z > 0.0f;
}

/// Appends the mask as a texture's alpha. Returns its index.
std::int32_t add_mask(const MeshDesc& desc, assets::MeshLibrary& library) {
    assets::Texture texture{std::string(desc.name), desc.mask.size_px.x, desc.mask.size_px.y, {}};
    texture.rgba.reserve(desc.mask.alpha.size() * 4);
    for (const std::uint8_t alpha : desc.mask.alpha) texture.rgba.insert(texture.rgba.end(), {255, 255, 255, alpha});
    return static_cast<std::int32_t>(library.add_texture(std::move(texture)));
}

/// Appends the material of a mesh that is cut out or translucent. Returns its index.
std::uint32_t add_material(const MeshDesc& desc, assets::MeshLibrary& library) {
    assets::Material material;
    material.name = desc.name;
    material.metallic = 0.0f;
    material.double_sided = desc.two_sided;
    material.transmission = desc.transmittance;
    if (has_mask(desc.mask)) {
        material.base_colour_texture = add_mask(desc, library);
        material.alpha_mode = assets::AlphaMode::mask;
        material.alpha_cutoff = desc.mask.cutoff;
    }
    return library.add_material(std::move(material));
}

}  // namespace

assets::MeshLibrary empty_library() {
    assets::MeshLibrary library;
    library.materials.resize(2);
    library.materials[kTwoSided].double_sided = true;
    return library;
}

Result<std::uint32_t> add_mesh(const MeshDesc& desc, assets::MeshLibrary& library) {
    if (desc.positions_m.empty() || desc.indices.empty() || desc.indices.size() % 3 != 0)
        return mesh_error(desc, "has no triangles, or indices that are no multiple of three", "mesh.empty");
    if (std::any_of(desc.indices.begin(), desc.indices.end(), [&](auto i) { return i >= desc.positions_m.size(); }))
        return mesh_error(desc, "has an index beyond its positions", "mesh.index");
    if (!std::all_of(desc.positions_m.begin(), desc.positions_m.end(), [](glm::dvec3 v) { return math::is_finite(v); }))
        return mesh_error(desc, "has a position that is not finite", "mesh.position");
    const bool masked = has_mask(desc.mask);
    const std::size_t texels = std::size_t{desc.mask.size_px.x} * desc.mask.size_px.y;
    if (masked && (desc.mask.alpha.size() != texels || desc.uvs.size() != desc.positions_m.size() ||
                   !(desc.mask.cutoff > 0.0f && desc.mask.cutoff <= 1.0f)))
        return mesh_error(desc,
                          "has a mask of another size, without a uv per position, or with a cutoff outside (0, 1]",
                          "mesh.mask");
    assets::Mesh mesh;
    mesh.name = desc.name;
    mesh.vertices.resize(desc.positions_m.size());
    for (std::size_t i = 0; i < desc.positions_m.size(); ++i) {
        mesh.vertices[i].position_ms = desc.positions_m[i];
        if (masked) mesh.vertices[i].uv = desc.uvs[i];
        mesh.bounds_ms = math::extended(mesh.bounds_ms, glm::dvec3(desc.positions_m[i]));
    }
    mesh.indices.assign(desc.indices.begin(), desc.indices.end());
    const bool own = masked || is_translucent(desc.transmittance);
    const std::uint32_t material = own ? add_material(desc, library) : desc.two_sided ? kTwoSided : kOneSided;
    mesh.submeshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), material}};
    mesh.topology = assets::analyse_topology(mesh);
    mesh.shape = assets::shape_of(mesh);
    return library.add(std::move(mesh));
}

std::uint32_t add_box(std::string_view name, const Bounds& bounds_ms, assets::MeshLibrary& library) {
    assets::Mesh mesh;
    mesh.name = name;
    mesh.bounds_ms = {bounds_ms.min_m, bounds_ms.max_m};
    return library.add(std::move(mesh));
}

void change_box(std::uint32_t mesh, const Bounds& bounds_ms, assets::MeshLibrary& library) {
    assets::Mesh changed = std::move(library.meshes[mesh]);
    changed.bounds_ms = {bounds_ms.min_m, bounds_ms.max_m};
    library.replace(mesh, std::move(changed));
}

void remove_mesh(std::uint32_t mesh, assets::MeshLibrary& library) {
    if (library.meshes[mesh].submeshes.empty()) return library.remove(mesh);
    const std::uint32_t material = library.meshes[mesh].submeshes.front().material;
    library.remove(mesh);
    if (material == kOneSided || material == kTwoSided) return;
    const std::int32_t texture = library.materials[material].base_colour_texture;
    library.remove_material(material);
    if (texture != assets::kNone) library.remove_texture(static_cast<std::uint32_t>(texture));
}

}  // namespace gnomon::embed
