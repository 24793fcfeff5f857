#include "systems/extract/caster_triangles.h"

namespace gnomon {
namespace {

/// Returns the material of each triangle of the mesh; kNone if no submesh draws it.
std::vector<std::uint32_t> materials_of(const assets::Mesh& mesh) {
    std::vector<std::uint32_t> materials(mesh.indices.size() / 3, static_cast<std::uint32_t>(assets::kNone));
    for (const assets::Submesh& s : mesh.submeshes)
        for (std::uint32_t i = s.first_index / 3; i < (s.first_index + s.index_count) / 3; ++i)
            materials[i] = s.material;
    return materials;
}

}  // namespace

void append_caster_triangles(const assets::MeshLibrary& library, std::uint32_t index, std::uint32_t first,
                             RayMasks& masks, std::vector<CasterTriangle>& triangles) {
    const assets::Mesh& mesh = library.meshes[index];
    const std::vector<std::uint32_t> neighbours = assets::triangle_neighbours(mesh);
    const std::vector<std::uint32_t> materials = materials_of(mesh);
    const auto is = [&](std::uint32_t t, assets::AlphaMode mode) {
        return materials[t] < library.materials.size() && library.materials[materials[t]].alpha_mode == mode;
    };
    for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
        CasterTriangle& triangle = triangles.emplace_back();
        for (std::uint32_t c = 0; c < 3; ++c) {
            triangle.corners[c].position_ms = mesh.vertices[mesh.indices[3 * t + c]].position_ms;
            const std::uint32_t across = neighbours[3 * t + c];
            if (across != assets::kNoNeighbour && is(t, assets::AlphaMode::opaque) &&
                is(across, assets::AlphaMode::opaque))
                triangle.corners[c].across = first + across;
        }
        if (!is(t, assets::AlphaMode::mask)) continue;
        const RayMasks::Place place = masks.place(index, t, materials[t]);
        triangle.corners[0].across = kMaskedTriangle;
        triangle.corners[1].across = place.mask;
        triangle.corners[2].across = place.uvs;
    }
}

CasterTriangleList caster_triangles_of(const assets::MeshLibrary& library) {
    CasterTriangleList all;
    RayMasks masks(library);
    for (std::uint32_t m = 0; m < library.meshes.size(); ++m)
        append_caster_triangles(library, m, static_cast<std::uint32_t>(all.triangles.size()), masks, all.triangles);
    all.masks.assign(masks.words().begin(), masks.words().end());
    return all;
}

}  // namespace gnomon
