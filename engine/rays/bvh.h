#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/math/shape_tree.h"

/// A bounding volume hierarchy as two plain arrays, the same on the CPU and in a storage buffer.
namespace gnomon::rays {

using Box = math::ShapeTree::Box;

/// A tree is at most that deep: 64 uneven cuts, then halves of at most 2^28 items.
inline constexpr std::size_t kMostDepth = 64 + 28;

inline bool is_empty(const Box& box) { return !(box.min.x <= box.max.x); }

/// 32 bytes; two vec4 with an unsigned in each w. Nodes lie in the order of a walk that takes the first child first,
/// so that no stack is needed: from node n go to n + 1 where its box is met, else to nodes[n].skip, and end at the
/// number of nodes. A leaf has skip n + 1.
struct BvhNode {
    glm::vec3 min{0.0f};
    std::uint32_t skip = 0;  // the node after all that is below
    glm::vec3 max{0.0f};
    std::uint32_t leaf = 0;  // its first slot * 16 + how many, 1 to 15; 0: not a leaf

    std::uint32_t first_slot() const { return leaf >> 4; }
    std::uint32_t slots() const { return leaf & 15u; }
};
static_assert(sizeof(BvhNode) == 32);

/// What a ray can expect of a tree whose root it meets, by the surface area heuristic: boxes it meets, triangles it is
/// tested with.
struct BvhCost {
    double nodes = 0.0, triangles = 0.0;
};

struct Bvh {
    std::vector<BvhNode> nodes;
    std::vector<std::uint32_t> items;  // by slot
};

/// Items of a leaf of triangles.
inline constexpr std::uint32_t kMostSlots = 8;

/// Over item i in boxes[i], at most `most_slots` (1 to 15) of which share a leaf. By the surface area heuristic over
/// bins (Wald 2007). An empty box belongs to nobody's box. Equal input gives an equal tree. O(n log n). At most 2^28
/// boxes.
Bvh build_bvh(std::span<const Box> boxes, std::uint32_t most_slots = kMostSlots);

/// All boxes anew, from those of the slots, when items moved; the shape stays. O(n).
void refit_bvh(std::vector<BvhNode>& nodes, std::span<const Box> box_of_slot);

BvhCost cost_of(std::span<const BvhNode> nodes);

}  // namespace gnomon::rays
