#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::assets {

/// Corner c of face f is half-edge 3 f + c; it runs from its corner to the next one of the face.
using WeldedFace = std::array<std::uint32_t, 3>;

inline constexpr std::uint32_t kNoHalfEdge = 0xFFFFFFFFU;

struct EdgePairing {
    std::vector<std::uint32_t> opposite;  // per half-edge; kNoHalfEdge on a boundary and on every cut edge
    std::vector<bool> cut;                // per half-edge: it lies on a non-manifold edge
    std::vector<std::array<std::uint32_t, 2>> cut_neighbours;  // half-edges that share a non-manifold edge, chained
    std::uint32_t non_manifold_edges = 0;
};

/// Pairs the half-edges of faces whose three vertices differ. An edge of two faces that run along it in opposite
/// directions is paired; an edge of one face is a boundary; any other edge is non-manifold and cut open, so that what
/// remains is a manifold (Guéziec et al. 2001, "Cutting and stitching"). Linear but for sorting within a vertex.
EdgePairing pair_half_edges(const std::vector<WeldedFace>& faces, std::uint32_t vertex_count);

inline std::uint32_t next_half_edge(std::uint32_t half_edge) {
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

}  // namespace gnomon::assets
