#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/bvh.h"

/// Trees that rays walk, split by the surface area heuristic; the same on the CPU and in a storage buffer.
namespace gnomon::rays {

using Box = math::FloatBox;

/// Maximum depth of a tree: 64 uneven cuts, then halves of at most 2^28 items.
inline constexpr std::size_t kMostDepth = 64 + 28;

inline bool is_empty(const Box& box) { return !(box.min.x <= box.max.x); }

/// Node of a tree; 32 bytes, in a shader two vec4 with an unsigned in each w.
using BvhNode = math::BvhNode<Box>;
static_assert(sizeof(BvhNode) == 32);

/// Expected cost of a ray that hits the root, by the surface area heuristic: boxes hit, and triangles tested.
struct BvhCost {
    double nodes = 0.0, triangles = 0.0;
    double steps() const { return nodes + triangles; }
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
