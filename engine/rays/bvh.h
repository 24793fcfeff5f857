#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/math/shape_tree.h"

/// Bounding volume hierarchy as two plain arrays, the same on the CPU and in a storage buffer.
namespace gnomon::rays {

using Box = math::ShapeTree::Box;

/// Maximum depth of a tree: 64 uneven cuts, then halves of at most 2^28 items.
inline constexpr std::size_t kMostDepth = 64 + 28;

inline bool is_empty(const Box& box) { return !(box.min.x <= box.max.x); }

/// Node of a tree; 32 bytes, in a shader two vec4 with an unsigned in each w. Nodes lie in preorder, first child first,
/// so that a walk needs no stack. After node n a walk visits n + 1 if it hits the box, otherwise nodes[n].skip. It ends
/// at the number of nodes. A leaf has skip n + 1.
struct BvhNode {
    glm::vec3 min{0.0f};
    std::uint32_t skip = 0;  // first node after the subtree
    glm::vec3 max{0.0f};
    std::uint32_t leaf = 0;  // first slot * 16 + number of slots (1 to 15); 0: no leaf

    std::uint32_t first_slot() const { return leaf >> 4; }
    std::uint32_t slots() const { return leaf & 15u; }
};
static_assert(sizeof(BvhNode) == 32);

/// Expected cost of a ray that hits the root, by the surface area heuristic: boxes hit, and triangles tested.
struct BvhCost {
    double nodes = 0.0, triangles = 0.0;
};

struct Bvh {
    std::vector<BvhNode> nodes;
    std::vector<std::uint32_t> items;  // item numbers by slot
};

/// Maximum number of triangles in a leaf.
inline constexpr std::uint32_t kMostSlots = 8;

/// Builds a tree over items i with boxes[i], by the binned surface area heuristic (Wald 2007). At most `most_slots` (1
/// to 15) items share a leaf. Items with an empty box enlarge no node. Equal input gives an equal tree. O(n log n). At
/// most 2^28 boxes.
Bvh build_bvh(std::span<const Box> boxes, std::uint32_t most_slots = kMostSlots);

/// Recomputes all boxes from those of the slots after items moved; the tree keeps its shape. O(n).
void refit_bvh(std::vector<BvhNode>& nodes, std::span<const Box> box_of_slot);

BvhCost cost_of(std::span<const BvhNode> nodes);

}  // namespace gnomon::rays
