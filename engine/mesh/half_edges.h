#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::assets {

/// Face of welded vertices. Its corner c is the start of half-edge 3 f + c, which ends at the next corner of face f.
using WeldedFace = std::array<std::uint32_t, 3>;

inline constexpr std::uint32_t kNoHalfEdge = 0xFFFFFFFFU;

struct EdgePairing {
    std::vector<std::uint32_t> opposite;  // per half-edge; kNoHalfEdge on a boundary and on every cut edge
    std::vector<bool> cut;                // per half-edge: lies on a non-manifold edge
    std::vector<std::array<std::uint32_t, 2>> cut_neighbours;  // half-edges that share a non-manifold edge, chained
    std::uint32_t non_manifold_edges = 0;
};

/// Pairs the half-edges of faces with three different vertices. An edge of two faces with opposite directions is
/// paired; an edge of one face is a boundary. Any other edge is non-manifold and cut, so that the rest is a manifold
/// (Guéziec et al. 2001, "Cutting and stitching"). Linear, except for sorting within a vertex.
EdgePairing pair_half_edges(const std::vector<WeldedFace>& faces, std::uint32_t vertex_count);

inline std::uint32_t next_half_edge(std::uint32_t half_edge) {
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

}  // namespace gnomon::assets
