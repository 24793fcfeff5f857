#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/math/bvh.h"
#include "engine/math/frustum.h"

namespace gnomon::math {

/// Linear function over space: dot(gradient, p) + offset, for example a distance along a direction.
struct Ramp {
    glm::dvec3 gradient{0.0};
    double offset = 0.0;
};

/// Bounds from below the lowest value of `ramp` over the part of the box inside all planes. The bound is low by 2^-21
/// of the size of the ramp's terms, eight times the rounding of a float. It thus covers the coordinates that a GPU
/// computes for points in the box. Returns `no_more_than` where that is lower, or nothing lies inside. At most
/// kMaxClipPlanes planes of any length. `scratch` is overwritten.
double lowest_in(const Aabb& box, const Ramp& ramp, std::span<const Plane> planes, double no_more_than,
                 std::vector<glm::dvec3>& scratch);

/// Computes the same bound from the box's corners, without clipping: cheaper, never higher. Infinite where the box lies
/// outside.
double lowest_corner(const Aabb& box, const Ramp& ramp, std::span<const Plane> planes);

/// Binary tree over boxes around the parts of a rigid shape, such as a mesh's triangles. A leaf has up to eight parts
/// that lie close together, and stores only their common box. 8 to 64 bytes per part.
class ShapeTree {
public:
    ShapeTree() = default;
    /// Builds the tree over finite boxes. O(n log n). Equal input gives an equal tree.
    explicit ShapeTree(std::span<const FloatBox> parts);

    /// Computes the lowest lowest_in() over all leaves. Branch and bound: the cost is that of the leaves near the
    /// answer.
    double lowest(const Ramp& ramp, std::span<const Plane> planes, double no_more_than,
                  std::vector<glm::dvec3>& scratch) const;

    bool empty() const { return nodes_.empty(); }
    std::size_t bytes() const { return nodes_.size() * sizeof(Node); }

private:
    using Node = BvhNode<FloatBox>;

    std::vector<Node> nodes_;
};

}  // namespace gnomon::math
