#include "engine/assets/openmesh_parts.h"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <algorithm>

#include "engine/mesh/disjoint_sets.h"

namespace gnomon::assets {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

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

std::vector<std::uint32_t> components(const OpenMesh::TriConnectivity& mesh, const EdgePairing& pairing) {
    DisjointSets faces(mesh.n_faces());
    for (const auto edge : mesh.edges()) {
        if (mesh.is_boundary(edge)) continue;
        faces.unite(static_cast<std::uint32_t>(mesh.face_handle(mesh.halfedge_handle(edge, 0)).idx()),
                    static_cast<std::uint32_t>(mesh.face_handle(mesh.halfedge_handle(edge, 1)).idx()));
    }
    for (const auto& [a, b] : pairing.cut_neighbours) faces.unite(a / 3, b / 3);
    return faces.firsts();
}

}  // namespace

SurfaceParts openmesh_parts(const std::vector<WeldedFace>& faces, const EdgePairing& pairing) {
    const OpenMesh::TriConnectivity mesh = ManifoldBuilder(faces.size(), pairing).build();
    return {boundary_edges(mesh, pairing), components(mesh, pairing)};
}

}  // namespace gnomon::assets
