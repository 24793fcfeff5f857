#include "engine/assets/mesh_topology.h"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "engine/assets/half_edges.h"
#include "engine/assets/mesh_weld.h"

namespace gnomon::assets {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// Union-find with path halving and union by index: near-linear, no recursion.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

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

/// Cut mesh as OpenMesh connectivity. OpenMesh's add_face rejects non-manifold faces and searches around each vertex,
/// in quadratic time at a vertex of many faces. With the pairing known, nothing is left to reject, and linking is
/// linear.
class ManifoldBuilder {
public:
    ManifoldBuilder(std::size_t face_count, const EdgePairing& pairing)
        : face_count_(static_cast<std::uint32_t>(face_count)), pairing_(pairing), handles_(face_count * 3) {}

    OpenMesh::TriConnectivity build() {
        add_vertices();
        add_edges();
        add_faces();
        link_boundaries();
        return mesh_;
    }

private:
    /// Adds a vertex for each set of corners that manifold edges join around a point: a disc or half a disc.
    void add_vertices() {
        DisjointSets corners(handles_.size());
        for (std::uint32_t h = 0; h < handles_.size(); ++h) {
            const std::uint32_t opposite = pairing_.opposite[h];
            if (opposite != kNoHalfEdge) corners.unite(h, next_half_edge(opposite));
        }
        vertices_.resize(handles_.size());
        for (std::uint32_t h = 0; h < handles_.size(); ++h) {
            const std::uint32_t first = corners.find(h);  // the smallest of its set, visited before
            vertices_[h] = first == h ? mesh_.new_vertex() : vertices_[first];
        }
    }

    void add_edges() {
        for (std::uint32_t h = 0; h < handles_.size(); ++h) {
            const std::uint32_t opposite = pairing_.opposite[h];
            if (opposite < h) {
                handles_[h] = mesh_.opposite_halfedge_handle(handles_[opposite]);
            } else {
                handles_[h] = mesh_.new_edge(vertices_[h], vertices_[next_half_edge(h)]);
            }
        }
    }

    void add_faces() {
        for (std::uint32_t f = 0; f < face_count_; ++f) {
            const FaceHandle face = mesh_.new_face();
            mesh_.set_halfedge_handle(face, handles_[std::size_t{3} * f]);
            for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
                mesh_.set_face_handle(handles_[h], face);
                mesh_.set_next_halfedge_handle(handles_[h], handles_[next_half_edge(h)]);
                mesh_.set_halfedge_handle(vertices_[h], handles_[h]);
            }
        }
    }

    /// Sets the outgoing half-edge of boundary vertices. A half disc has exactly one outgoing boundary half-edge, which
    /// OpenMesh requires as the vertex's own.
    void link_boundaries() {
        for (std::uint32_t h = 0; h < handles_.size(); ++h) {
            if (pairing_.opposite[h] != kNoHalfEdge) continue;
            mesh_.set_halfedge_handle(vertices_[next_half_edge(h)], mesh_.opposite_halfedge_handle(handles_[h]));
        }
        for (std::uint32_t h = 0; h < handles_.size(); ++h) {
            if (pairing_.opposite[h] != kNoHalfEdge) continue;
            mesh_.set_next_halfedge_handle(mesh_.opposite_halfedge_handle(handles_[h]),
                                           mesh_.halfedge_handle(vertices_[h]));
        }
    }

    std::uint32_t face_count_;
    const EdgePairing& pairing_;
    OpenMesh::TriConnectivity mesh_;
    std::vector<HalfedgeHandle> handles_;
    std::vector<VertexHandle> vertices_;  // per half-edge: start vertex
};

std::uint32_t boundary_edges(const OpenMesh::TriConnectivity& mesh, const EdgePairing& pairing) {
    std::uint32_t count = 0;
    for (const auto edge : mesh.edges()) count += mesh.is_boundary(edge) ? 1U : 0U;
    const auto cuts = static_cast<std::uint32_t>(std::count(pairing.cut.begin(), pairing.cut.end(), true));
    return count - cuts;
}

/// Groups faces into components connected by edges, including non-manifold ones.
DisjointSets face_pieces(const OpenMesh::TriConnectivity& mesh, const EdgePairing& pairing) {
    DisjointSets faces(mesh.n_faces());
    for (const auto edge : mesh.edges()) {
        if (mesh.is_boundary(edge)) continue;
        faces.unite(static_cast<std::uint32_t>(mesh.face_handle(mesh.halfedge_handle(edge, 0)).idx()),
                    static_cast<std::uint32_t>(mesh.face_handle(mesh.halfedge_handle(edge, 1)).idx()));
    }
    for (const auto& [a, b] : pairing.cut_neighbours) faces.unite(a / 3, b / 3);
    return faces;
}

/// Computes six times the enclosed volume of each component, indexed by its first face. Negative if wound inward.
std::vector<double> volumes(const Mesh& mesh, const std::vector<std::uint32_t>& welded,
                            const std::vector<WeldedFace>& faces, DisjointSets& pieces) {
    std::vector<glm::dvec3> places(welded.size());
    for (std::size_t v = 0; v < welded.size(); ++v) places[welded[v]] = glm::dvec3(mesh.vertices[v].position_ms);
    std::vector<double> sums(faces.size(), 0.0);
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const std::uint32_t first = pieces.find(f);
        const glm::dvec3& origin = places[faces[first][0]];  // the component's own, so that nothing large cancels
        const glm::dvec3 a = places[faces[f][0]] - origin, b = places[faces[f][1]] - origin;
        sums[first] += glm::dot(a, glm::cross(b, places[faces[f][2]] - origin));
    }
    return sums;
}

}  // namespace

Topology analyse_topology(const Mesh& mesh) {
    Topology topology;
    const std::vector<std::uint32_t> welded = weld_by_position(mesh.vertices);
    const ProperFaces proper = proper_faces(mesh, welded);
    const std::vector<WeldedFace>& faces = proper.faces;
    topology.degenerate_faces = degenerate_faces(mesh, proper);
    const EdgePairing pairing = pair_half_edges(faces, proper.vertex_count);
    const OpenMesh::TriConnectivity manifold = ManifoldBuilder(faces.size(), pairing).build();
    topology.non_manifold_edges = pairing.non_manifold_edges;
    topology.boundary_edges = boundary_edges(manifold, pairing);
    topology.closed = !faces.empty() && topology.boundary_edges == 0 && topology.non_manifold_edges == 0;
    topology.outward = topology.closed;
    DisjointSets pieces = face_pieces(manifold, pairing);
    const std::vector<double> volume = volumes(mesh, welded, faces, pieces);
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        if (pieces.find(f) != f) continue;
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
