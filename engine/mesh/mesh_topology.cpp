#include "engine/mesh/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/half_edges.h"
#include "engine/mesh/mesh_weld.h"

namespace gnomon::assets {
namespace {

/// Returns true if the triangle has area. The product of two floats is exact in double, so that collinear corners on a
/// common grid give exactly zero.
bool has_area(const Mesh& mesh, std::size_t first_index) {
    const glm::dvec3 a(mesh.vertices[mesh.indices[first_index]].position_ms);
    const glm::dvec3 b(mesh.vertices[mesh.indices[first_index + 1]].position_ms);
    const glm::dvec3 c(mesh.vertices[mesh.indices[first_index + 2]].position_ms);
    return glm::cross(b - a, c - a) != glm::dvec3(0.0);
}

/// Faces with three different welded vertices, and their indices in the triangle list. Slivers without area stay: they
/// close gaps that only rounding opened.
struct ProperFaces {
    std::vector<WeldedFace> faces;
    std::vector<std::uint32_t> triangles;
    std::uint32_t vertex_count = 0;
};

ProperFaces proper_faces(const Mesh& mesh, const std::vector<std::uint32_t>& welded) {
    ProperFaces proper;
    proper.faces.reserve(mesh.indices.size() / 3);
    proper.triangles.reserve(mesh.indices.size() / 3);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const WeldedFace face{welded[mesh.indices[i]], welded[mesh.indices[i + 1]], welded[mesh.indices[i + 2]]};
        if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
        proper.faces.push_back(face);
        proper.triangles.push_back(static_cast<std::uint32_t>(i / 3));
    }
    proper.vertex_count = welded.empty() ? 0 : *std::max_element(welded.begin(), welded.end()) + 1;
    return proper;
}

/// Counts triangles with zero area or repeated vertices.
std::uint32_t degenerate_faces(const Mesh& mesh, const ProperFaces& proper) {
    auto count = static_cast<std::uint32_t>(mesh.indices.size() / 3 - proper.faces.size());
    for (const std::uint32_t triangle : proper.triangles) count += has_area(mesh, std::size_t{3} * triangle) ? 0 : 1;
    return count;
}

/// Computes six times the enclosed volume of each component, indexed by its first face. Negative if wound inward.
std::vector<double> volumes(const Mesh& mesh, const std::vector<std::uint32_t>& welded,
                            const std::vector<WeldedFace>& faces, const std::vector<std::uint32_t>& pieces) {
    std::vector<glm::dvec3> places(welded.size());
    for (std::size_t v = 0; v < welded.size(); ++v) places[welded[v]] = glm::dvec3(mesh.vertices[v].position_ms);
    std::vector<double> sums(faces.size(), 0.0);
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const std::uint32_t first = pieces[f];
        const glm::dvec3& origin = places[faces[first][0]];  // the component's own, so that nothing large cancels
        const glm::dvec3 a = places[faces[f][0]] - origin, b = places[faces[f][1]] - origin;
        sums[first] += glm::dot(a, glm::cross(b, places[faces[f][2]] - origin));
    }
    return sums;
}

}  // namespace

SurfaceParts surface_parts(const std::vector<WeldedFace>& faces, const EdgePairing& pairing) {
    SurfaceParts parts;
    DisjointSets sets(faces.size());
    for (std::uint32_t h = 0; h < pairing.opposite.size(); ++h) {
        const std::uint32_t opposite = pairing.opposite[h];
        if (opposite != kNoHalfEdge) sets.unite(h / 3, opposite / 3);
        if (opposite == kNoHalfEdge && !pairing.cut[h]) ++parts.boundary_edges;
    }
    for (const auto& [a, b] : pairing.cut_neighbours) sets.unite(a / 3, b / 3);
    parts.first_face = sets.firsts();
    return parts;
}

Topology analyse_topology(const Mesh& mesh, SurfaceAnalysis analysis) {
    Topology topology;
    const std::vector<std::uint32_t> welded = weld_by_position(mesh.vertices);
    const ProperFaces proper = proper_faces(mesh, welded);
    const std::vector<WeldedFace>& faces = proper.faces;
    topology.degenerate_faces = degenerate_faces(mesh, proper);
    const EdgePairing pairing = pair_half_edges(faces, proper.vertex_count);
    const SurfaceParts parts = analysis(faces, pairing);
    topology.non_manifold_edges = pairing.non_manifold_edges;
    topology.boundary_edges = parts.boundary_edges;
    topology.closed = !faces.empty() && topology.boundary_edges == 0 && topology.non_manifold_edges == 0;
    topology.outward = topology.closed;
    const std::vector<double> volume = volumes(mesh, welded, faces, parts.first_face);
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        if (parts.first_face[f] != f) continue;
        ++topology.components;
        topology.outward = topology.outward && volume[f] > 0.0;
    }
    return topology;
}

std::vector<std::uint32_t> triangle_neighbours(const Mesh& mesh) {
    const ProperFaces proper = proper_faces(mesh, weld_by_position(mesh.vertices));
    const EdgePairing pairing = pair_half_edges(proper.faces, proper.vertex_count);
    std::vector<std::uint32_t> neighbours(mesh.indices.size() / 3 * 3, kNoNeighbour);
    for (std::uint32_t h = 0; h < pairing.opposite.size(); ++h)
        if (pairing.opposite[h] != kNoHalfEdge)
            neighbours[std::size_t{3} * proper.triangles[h / 3] + h % 3] = proper.triangles[pairing.opposite[h] / 3];
    return neighbours;
}

}  // namespace gnomon::assets
