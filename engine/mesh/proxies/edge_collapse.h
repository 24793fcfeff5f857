#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <queue>
#include <span>
#include <vector>

#include "engine/mesh/half_edges.h"

namespace gnomon::assets {

/// Squared distances from a set of planes, as a function of the place (Garland and Heckbert 1997, "Surface
/// simplification using quadric error metrics").
struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, x = 0, y = 0, z = 0, one = 0;
    void add_plane(const glm::dvec3& normal, double offset_m);
    void add(const Quadric& other);
    double at(const glm::dvec3& p) const;
};

/// Coarsening of a surface by moving vertices into neighbouring ones, the least change first. Vertices keep their
/// places, so that what is left lies in the hull of what was there. It states no bound: surface_distance() does.
/// Manifold parts stay manifold; boundaries and non-manifold edges keep their course.
class EdgeCollapse {
public:
    /// Takes a surface of finite points. Drops faces with a repeated vertex.
    EdgeCollapse(std::span<const glm::dvec3> points, std::span<const WeldedFace> faces);

    /// Collapses edges while the sum of squared distances from the original planes stays below `limit_m` squared.
    void run(double limit_m);
    /// Drops faces, by their number among live ones of faces().
    void drop(const std::vector<bool>& dropped);
    /// Returns the faces that are left, in their first order.
    std::vector<WeldedFace> faces() const;

private:
    struct Candidate {
        double cost_m2 = 0.0;
        std::uint32_t from = 0, to = 0, from_changes = 0, to_changes = 0;
        /// Orders by falling cost; equal ones by their vertices, so that equal input gives equal output.
        bool operator<(const Candidate& other) const;
    };
    void add_planes();
    void push_edges_of(std::uint32_t vertex);
    void push(std::uint32_t from, std::uint32_t to);
    bool may_collapse(std::uint32_t from, std::uint32_t to) const;
    bool turns_over(const WeldedFace& face, std::uint32_t from, std::uint32_t to) const;
    void collapse(std::uint32_t from, std::uint32_t to);
    void list_neighbours(std::uint32_t vertex, std::vector<std::uint32_t>& out) const;
    void drop_face(std::uint32_t face);

    std::vector<glm::dvec3> points_;
    std::vector<WeldedFace> faces_;
    std::vector<bool> dead_;                            // by face
    std::vector<std::vector<std::uint32_t>> faces_of_;  // live faces, by vertex
    std::vector<Quadric> quadrics_;                     // by vertex
    std::vector<std::uint32_t> changes_;                // by vertex
    std::priority_queue<Candidate> waiting_;
    mutable std::vector<std::uint32_t> one_, other_;  // neighbours, of two vertices
};

}  // namespace gnomon::assets
