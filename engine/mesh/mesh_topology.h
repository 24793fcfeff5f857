#pragma once
#include <cstdint>
#include <vector>

#include "engine/mesh/half_edges.h"
#include "gnomon/assets.h"

namespace gnomon::assets {

/// Boundary of a surface, and its components, which are connected by edges, including non-manifold ones.
struct SurfaceParts {
    std::uint32_t boundary_edges = 0;
    std::vector<std::uint32_t> first_face;  // first face of its component, by face
    bool operator==(const SurfaceParts&) const = default;
};
using SurfaceAnalysis = SurfaceParts (*)(const std::vector<WeldedFace>& faces, const EdgePairing& pairing);

/// Finds the parts from the pairing alone. assets/openmesh_parts.h finds the same by OpenMesh.
SurfaceParts surface_parts(const std::vector<WeldedFace>& faces, const EdgePairing& pairing);

/// Analyses the triangle list, after welding vertices with bitwise equal positions (-0 equals +0). Every finite mesh
/// has a result, including empty, degenerate and non-manifold ones. A face without area but with three different
/// vertices is degenerate and still closes the surface.
Topology analyse_topology(const Mesh& mesh, SurfaceAnalysis analysis = surface_parts);

inline constexpr std::uint32_t kNoNeighbour = 0xFFFFFFFFU;

/// Returns for each triangle its neighbours across the edges 0-1, 1-2 and 2-0. Edges are shared by position and have
/// opposite directions, as in analyse_topology(). kNoNeighbour at a boundary, at a non-manifold edge, and for a
/// triangle with two corners in one place.
std::vector<std::uint32_t> triangle_neighbours(const Mesh& mesh);

/// Fills normal_ms of every vertex flagged in `missing` (a flag per vertex) with the angle-weighted normal of its faces
/// (Thürmer & Wüthrich 1998). Zero if all its faces are degenerate or cancel. Vertices are not welded: a hard edge
/// stays hard.
void fill_normals(Mesh& mesh, const std::vector<bool>& missing);

}  // namespace gnomon::assets
