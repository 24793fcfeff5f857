#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/math/aabb.h"
#include "engine/math/bvh.h"

namespace gnomon::assets {

/// Corners of a triangle, which may have no area.
using TriangleCorners = std::array<glm::dvec3, 3>;

/// Returns the distance from `p` to a point of the triangle: the nearest one, up to rounding. Where rounding errs, it
/// is too large.
double distance_to(const TriangleCorners& triangle, const glm::dvec3& p);

/// Triangle near a point.
struct NearTriangle {
    double distance_m = 0.0;  // distance_to() of it; infinite: there is none
    std::uint32_t triangle = 0;
};

/// Tree over triangles that finds the nearest one.
class TriangleTree {
public:
    /// Builds the tree. `groups`: group of each triangle, for searches that leave groups out; empty: all are of group
    /// 0.
    explicit TriangleTree(std::vector<TriangleCorners> triangles, std::vector<std::uint32_t> groups = {});

    /// Finds the nearest triangle that is nearer than `limit_m`, of groups without a flag in `left_out`; empty: of all.
    NearTriangle nearest(const glm::dvec3& p, double limit_m, const std::vector<bool>& left_out = {}) const;
    const TriangleCorners& triangle(std::uint32_t i) const { return triangles_[i]; }

private:
    std::vector<TriangleCorners> triangles_;
    std::vector<std::uint32_t> groups_;
    std::vector<math::BvhNode<math::Aabb>> nodes_;
    std::vector<std::uint32_t> order_;  // triangle of each slot
};

}  // namespace gnomon::assets
