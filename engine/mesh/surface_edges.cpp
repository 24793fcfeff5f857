#include "engine/mesh/surface_edges.h"

#include "engine/mesh/half_edges.h"
#include "engine/mesh/mesh_weld.h"

namespace gnomon::assets {
namespace {

/// Included triangles with three different positions, and their indices in the list.
struct Included {
    std::vector<WeldedFace> faces;
    std::vector<std::uint32_t> triangles;
};

Included included_faces(const std::vector<std::uint32_t>& indices, const std::vector<bool>& included,
                        const std::vector<std::uint32_t>& welded) {
    Included found;
    for (std::size_t t = 0; t < indices.size() / 3; ++t) {
        const WeldedFace face{welded[indices[3 * t]], welded[indices[3 * t + 1]], welded[indices[3 * t + 2]]};
        if (!included[t] || face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
        found.faces.push_back(face);
        found.triangles.push_back(static_cast<std::uint32_t>(t));
    }
    return found;
}

}  // namespace

SurfaceEdges surface_edges(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices,
                           const std::vector<bool>& included) {
    const std::vector<std::uint32_t> welded = weld_by_position(vertices);
    const Included found = included_faces(indices, included, welded);
    const EdgePairing pairing = pair_half_edges(found.faces, static_cast<std::uint32_t>(welded.size()));
    const auto triangle_of = [&](std::uint32_t h) { return found.triangles[h / 3]; };
    const auto start_of = [&](std::uint32_t h) { return indices[std::size_t{3} * triangle_of(h) + h % 3]; };
    const auto end_of = [&](std::uint32_t h) { return start_of(next_half_edge(h)); };
    SurfaceEdges edges;
    for (std::uint32_t h = 0; h < pairing.opposite.size(); ++h) {
        const std::uint32_t opposite = pairing.opposite[h];
        if (opposite == kNoHalfEdge) {
            if (!pairing.cut[h]) edges.borders.push_back({start_of(h), end_of(h)});
        } else if (h < opposite) {
            edges.folds.push_back({start_of(h), end_of(h), triangle_of(h), triangle_of(opposite), false});
        }
    }
    // Half-edges of a non-manifold edge are chained; two of them form a single link.
    const auto& links = pairing.cut_neighbours;
    for (std::size_t i = 0; i < links.size();) {
        std::size_t end = i + 1;
        while (end < links.size() && links[end][0] == links[end - 1][1]) ++end;
        const auto [h, other] = links[i];
        if (end == i + 1)
            edges.folds.push_back({start_of(h), end_of(h), triangle_of(h), triangle_of(other), true});
        else
            edges.borders.push_back({start_of(h), end_of(h)});
        i = end;
    }
    return edges;
}

}  // namespace gnomon::assets
