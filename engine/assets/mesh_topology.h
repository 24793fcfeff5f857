#pragma once
#include "engine/assets/scene_data.h"

namespace gnomon::assets {

/// Analyses the triangle list with OpenMesh after welding vertices whose positions have identical bits
/// (-0 and +0 are the same). Total: every finite mesh has an answer, also empty, degenerate and non-manifold ones.
/// Components hang together by edges, non-manifold ones included. A face without area but with three different
/// vertices counts as degenerate and still closes the surface.
Topology analyse_topology(const Mesh& mesh);

/// Fills normal_ms of every vertex flagged in `missing` (one flag per vertex) with the angle-weighted normal of its
/// faces (Thürmer & Wüthrich 1998); zero where all its faces are degenerate or cancel.
/// Vertices are taken as they are indexed, not welded: a hard edge stays hard.
void fill_normals(Mesh& mesh, const std::vector<bool>& missing);

}  // namespace gnomon::assets
