#pragma once
#include <cstdint>
#include <vector>

#include "engine/assets/scene_data.h"

namespace gnomon::assets {

/// Analyses the triangle list with OpenMesh after welding vertices whose positions have identical bits
/// (-0 and +0 are the same). Total: every finite mesh has an answer, also empty, degenerate and non-manifold ones.
/// Components hang together by edges, non-manifold ones included. A face without area but with three different
/// vertices counts as degenerate and still closes the surface.
Topology analyse_topology(const Mesh& mesh);

inline constexpr std::uint32_t kNoNeighbour = 0xFFFFFFFFU;

/// Per triangle of the list, the triangle of the same list beyond each of its edges: corner 0 to 1, 1 to 2, 2 to 0. Edges
/// are shared by position and run in opposite directions, as in analyse_topology(); kNoNeighbour at a boundary, at a
/// non-manifold edge, and for a triangle with two corners in one place.
std::vector<std::uint32_t> triangle_neighbours(const Mesh& mesh);

/// Fills normal_ms of every vertex flagged in `missing` (one flag per vertex) with the angle-weighted normal of its
/// faces (Thürmer & Wüthrich 1998); zero where all its faces are degenerate or cancel.
/// Vertices are taken as they are indexed, not welded: a hard edge stays hard.
void fill_normals(Mesh& mesh, const std::vector<bool>& missing);

}  // namespace gnomon::assets
