#include "tests/oracle/caster_pieces.h"

#include <numeric>
#include <utility>

namespace gnomon::oracle {
namespace {

using Corner = std::array<float, 3>;

/// Returns a flag per triangle that an alpha mask cuts.
std::vector<bool> masked_triangles(const assets::MeshLibrary& library, const assets::Mesh& mesh) {
    std::vector<bool> masked(mesh.indices.size() / 3, false);
    for (const assets::Submesh& part : mesh.submeshes)
        if (part.material < library.materials.size() &&
            library.materials[part.material].alpha_mode == assets::AlphaMode::mask)
            for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3)
                masked[i / 3] = true;
    return masked;
}

std::vector<std::array<std::uint32_t, 2>> shared_edges(const assets::MeshLibrary& library, const assets::Mesh& mesh) {
    const std::vector<bool> masked = masked_triangles(library, mesh);
    std::vector<std::array<std::uint32_t, 2>> shared;
    std::map<std::pair<Corner, Corner>, std::uint32_t> first;
    const auto corner = [&](std::size_t index) {
        const auto& p = mesh.vertices[mesh.indices[index]].position_ms;
        return Corner{p.x, p.y, p.z};
    };
    for (std::uint32_t t = 0; t < masked.size(); ++t)
        for (std::uint32_t k = 0; k < 3 && !masked[t]; ++k) {
            auto edge = std::pair(corner(3 * t + k), corner(3 * t + (k + 1) % 3));
            if (edge.second < edge.first) std::swap(edge.first, edge.second);
            const auto [at, is_new] = first.try_emplace(edge, t);
            if (!is_new) shared.push_back({t, at->second});
        }
    return shared;
}

}  // namespace

CasterPieces::CasterPieces(const ReferenceTracer& tracer, const SceneSnapshot& snapshot,
                           const assets::MeshLibrary& library)
    : tracer_(tracer), snapshot_(snapshot), numbers_(snapshot.instances.size()) {
    for (std::uint32_t i = 0; i < tracer.triangle_count(); ++i) {
        const PlacedTriangle source = tracer.source_of(i);
        numbers_[source.instance][source.triangle] = i;
        const std::uint32_t mesh = snapshot.instances[source.instance].mesh;
        if (!edges_.contains(mesh)) edges_[mesh] = shared_edges(library, library.meshes[mesh]);
    }
}

std::vector<std::uint32_t> CasterPieces::seen_from(const LightItem& light) const {
    std::vector<std::uint32_t> parent(tracer_.triangle_count());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        if (numbers_[i].empty()) continue;
        for (const auto& [a, b] : edges_.at(snapshot_.instances[i].mesh)) {
            const auto of_a = numbers_[i].find(a), of_b = numbers_[i].find(b);
            if (of_a == numbers_[i].end() || of_b == numbers_[i].end()) continue;  // one without area
            if (tracer_.faces(of_a->second, light) == tracer_.faces(of_b->second, light))
                parent[root(of_a->second)] = root(of_b->second);
        }
    }
    for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
    return parent;
}

}  // namespace gnomon::oracle
