#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "engine/math/aabb.h"
#include "engine/math/frustum.h"

namespace gnomon::math {

/// A number that changes evenly over space: dot(gradient, p) + offset. As a distance along a direction it says how far
/// away things are.
struct Ramp {
    glm::dvec3 gradient{0.0};
    double offset = 0.0;
};

/// No more than the lowest value of `ramp` over the part of the box inside all planes, and hardly less: by 2^-21 of the
/// size of the ramp's terms, eight times what a float rounds by, so that it holds for whatever a GPU makes of points in
/// the box. `no_more_than` where that is lower, or nothing lies inside. At most kMaxClipPlanes planes, which need not
/// be of unit length. `scratch` is overwritten.
double lowest_in(const Aabb& box, const Ramp& ramp, std::span<const Plane> planes, double no_more_than,
                 std::vector<glm::dvec3>& scratch);

/// The same by the box's corners, unclipped: cheaper, never higher. Infinite where the box lies outside.
double lowest_corner(const Aabb& box, const Ramp& ramp, std::span<const Plane> planes);

/// Boxes around the parts of a shape that does not change, such as a mesh's triangles: a binary tree whose leaves hold
/// up to eight parts, if they lie close together, and know of them their common box alone. 7 to 56 bytes per part.
class ShapeTree {
public:
    /// In float, as vertices are.
    struct Box {
        glm::vec3 min{std::numeric_limits<float>::infinity()};
        glm::vec3 max{-std::numeric_limits<float>::infinity()};
    };

    ShapeTree() = default;
    /// Around these boxes, which are finite. O(n log n). Equal input gives an equal tree.
    explicit ShapeTree(std::vector<Box> parts);

    /// lowest_in() all leaves: branch and bound, so that it costs what the leaves near the answer cost.
    double lowest(const Ramp& ramp, std::span<const Plane> planes, double no_more_than,
                  std::vector<glm::dvec3>& scratch) const;

    bool empty() const { return nodes_.empty(); }
    std::size_t bytes() const { return nodes_.size() * sizeof(Node); }

private:
    struct Node {
        glm::vec3 ends[2];           // of its box
        std::uint32_t children = 0;  // the first of two, side by side; 0: a leaf
    };
    void make_node(std::uint32_t node, std::span<Box> parts);

    std::vector<Node> nodes_;
};

}  // namespace gnomon::math
