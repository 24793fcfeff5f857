#include "systems/shadow/exact/caster_topology.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace gnomon::shadow {
namespace {

CasterTopology::Facet facet_of(const GpuScene::MeshShape& shape, std::size_t triangle) {
    const auto corner = [&](std::size_t c) {
        return (*shape.vertices)[(*shape.indices)[3 * triangle + c]].position_ms;
    };
    const glm::dvec3 a(corner(0)), b(corner(1)), c(corner(2));
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double size = glm::length(normal);
    if (!(size > 0.0)) return {glm::vec3(0.0f), corner(0), 0.0f};
    const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    return {glm::vec3(normal / size), corner(0), static_cast<float>(size / longest)};
}

void fill(const GpuScene& gpu, std::uint32_t mesh, const GpuScene::MeshShape& shape, CasterTopology& surface) {
    const GpuScene::MeshRange& range = gpu.mesh(mesh);
    const std::size_t count = shape.indices->size() / 3;
    surface.opaque.clear();
    surface.masked.clear();
    std::vector<bool> included(count, false);
    for (std::uint32_t s = 0; s < range.submesh_count; ++s) {
        const GpuScene::SubmeshRange& submesh = gpu.submesh(range.first_submesh + s);
        const assets::AlphaMode alpha = gpu.material(submesh.material).alpha_mode;
        if (gpu.material(submesh.material).transmits) continue;
        const std::uint32_t first = (submesh.first_index - range.first_index) / 3;
        for (std::uint32_t t = first; t < first + submesh.index_count / 3; ++t) {
            included[t] = alpha == assets::AlphaMode::opaque;
            (included[t] ? surface.opaque : surface.masked).push_back(t);
        }
    }
    surface.edges = assets::surface_edges(*shape.vertices, *shape.indices, included);
    surface.facets.resize(count);
    for (std::size_t t = 0; t < count; ++t) surface.facets[t] = facet_of(shape, t);
    surface.reach_ms = glm::dvec3(0.0);
    for (const assets::Vertex& vertex : *shape.vertices)
        surface.reach_ms = glm::max(surface.reach_ms, glm::abs(glm::dvec3(vertex.position_ms)));
}

}  // namespace

std::uint64_t CasterTopologies::bytes_of(const CasterTopology& surface) {
    return surface.edges.borders.capacity() * sizeof(assets::SurfaceEdges::Border) +
           surface.edges.folds.capacity() * sizeof(assets::SurfaceEdges::Fold) +
           surface.facets.capacity() * sizeof(CasterTopology::Facet) +
           (surface.opaque.capacity() + surface.masked.capacity()) * sizeof(std::uint32_t);
}

/// Frees the surfaces of meshes that went or were replaced.
void CasterTopologies::forget_changed(const assets::MeshLibrary& library) {
    library_version_ = library.version;
    for (std::uint32_t mesh = 0; mesh < kept_.size(); ++mesh) {
        if (!kept_[mesh].made || kept_[mesh].mesh_version == library.version_of(mesh)) continue;
        bytes_ -= bytes_of(kept_[mesh].surface);
        kept_[mesh] = {};
    }
}

const CasterTopology& CasterTopologies::of(const GpuScene& gpu, std::uint32_t mesh) {
    if (library_version_ != gpu.library().version) forget_changed(gpu.library());
    if (kept_.size() < gpu.mesh_count()) kept_.resize(gpu.mesh_count());
    Kept& kept = kept_[mesh];
    const GpuScene::MeshShape shape = gpu.shape(mesh);
    if (!kept.made || kept.version != shape.version) {
        bytes_ -= bytes_of(kept.surface);
        fill(gpu, mesh, shape, kept.surface);
        bytes_ += bytes_of(kept.surface);
    }
    kept.made = true;
    kept.version = shape.version;
    kept.mesh_version = shape.mesh_version;
    return kept.surface;
}

}  // namespace gnomon::shadow
