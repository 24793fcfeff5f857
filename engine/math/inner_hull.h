#pragma once
#include <compare>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/math/aabb.h"

namespace gnomon::math {

/// Convex polyhedron around points. A box that it contains adds nothing to any convex hull, maximum or minimum over a
/// set with these points. Storage is reused.
class InnerHull {
public:
    /// Points that build() uses at most: facets are twice as many, and each box is tested against all.
    static constexpr std::size_t kMostPoints = 64;

    /// Builds the hull of the points, one after the other (Edelsbrunner 1987, section 8.4). It
    /// contains no box if the points lie in a plane, up to rounding, or if a coordinate is not finite.
    void build(std::span<const glm::dvec3> points);
    /// Returns whether the whole box lies within, borders included. An empty box does not. `last_facet`: the facet
    /// to test first, any number. Becomes the facet that the box lies beyond; near boxes often share it.
    bool contains(const Aabb& box, std::size_t& last_facet) const;
    bool contains(const Aabb& box) const {
        std::size_t none = 0;
        return contains(box, none);
    }
    /// Returns the outward normals of the facets, of any length; empty: it contains no box.
    std::span<const glm::dvec3> normals() const { return normals_; }

private:
    struct Facet {
        std::size_t corners[3];
        glm::dvec3 normal;
        double offset;  // dot(normal, p) for points p of its plane
    };
    struct Edge {
        std::size_t from, to;
        auto operator<=>(const Edge&) const = default;
    };

    bool start(std::span<const glm::dvec3> points);
    void add(std::span<const glm::dvec3> points, std::size_t point);
    void add_facet(std::span<const glm::dvec3> points, std::size_t a, std::size_t b, std::size_t c);
    bool is_closed();
    bool holds(std::span<const glm::dvec3> points) const;

    std::vector<Facet> facets_;
    std::vector<Edge> edges_;
    std::vector<glm::dvec3> normals_;
    std::vector<double> offsets_;
    Aabb bounds_;
    double slack_ = 0.0;  // distance from a plane that counts as on it, per length of the normal
};

}  // namespace gnomon::math
