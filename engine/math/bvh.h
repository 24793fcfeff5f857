#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "engine/math/aabb.h"

/// Bounding volume hierarchy as plain arrays: the nodes of all trees, their builder, and the search for a lowest value.
/// A `Box` is an Aabb (culling) or a FloatBox (meshes, rays). What a tree is good for depends on how nodes are split.
namespace gnomon::math {

/// Box in float, like vertices. A default box is empty.
struct FloatBox {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};
};

/// Enlarges `box` to hold `other`, which is no NaN; an empty box adds nothing.
template <class Box>
void grow(Box& box, const Box& other) {
    box = {glm::min(box.min, other.min), glm::max(box.max, other.max)};
}

/// Node of a tree. Nodes lie in preorder, first child first: node n has the children n + 1 and nodes[n + 1].skip. A
/// walk without a stack visits n + 1 if it hits the box, otherwise nodes[n].skip, up to the number of nodes.
template <class Box>
struct BvhNode {
    decltype(Box::min) min{0};
    std::uint32_t skip = 0;  // first node after the subtree; of a leaf n + 1
    decltype(Box::max) max{0};
    std::uint32_t leaf = 0;  // first slot * 16 + number of slots (1 to 15); 0: no leaf

    Box box() const { return {min, max}; }
    std::uint32_t first_slot() const { return leaf >> 4; }
    std::uint32_t slots() const { return leaf & 15u; }
};

/// Item of a tree while it is built; afterwards items lie in the order of the leaves' slots.
template <class Box>
struct BvhItem {
    Box box;
    std::uint32_t item = 0;
};

/// Appends the nodes of a tree over at most 2^28 items, and puts the items in the order of their slots, from
/// `first_slot` on. split(items, box of the items, depth) arranges items and returns how many go to the first child.
/// 0: the items, at most 15, share a leaf.
template <class Box, class Split>
void append_nodes(std::vector<BvhNode<Box>>& nodes, std::span<BvhItem<Box>> items, const Split& split,
                  std::uint32_t first_slot = 0, int depth = 0) {
    if (items.empty()) return;
    const std::size_t index = nodes.size();
    Box all;
    for (const BvhItem<Box>& item : items) grow(all, item.box);
    nodes.push_back({all.min, 0, all.max, 0});
    const std::size_t half = split(items, all, depth);
    if (half == 0) {
        nodes[index].leaf = first_slot * 16 + static_cast<std::uint32_t>(items.size());
    } else {
        append_nodes(nodes, items.first(half), split, first_slot, depth + 1);
        append_nodes(nodes, items.subspan(half), split, first_slot + static_cast<std::uint32_t>(half), depth + 1);
    }
    nodes[index].skip = static_cast<std::uint32_t>(nodes.size());
}

/// Splits at the middle item, along the longest side of the box of all centres. Equal centres are ordered by item
/// number, so that different numbers give one order. centre(box) is finite, of any scale. Returns the size of the first
/// half. O(n).
template <class Box, class Centre>
std::size_t halve(std::span<BvhItem<Box>> items, const Centre& centre) {
    Box centres;
    for (const BvhItem<Box>& item : items) {
        const auto at = centre(item.box);
        grow(centres, {at, at});
    }
    const int axis = longest_side(glm::dvec3(centres.max - centres.min));
    const std::size_t half = items.size() / 2;
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                     [&](const BvhItem<Box>& a, const BvhItem<Box>& b) {
                         const auto at_a = centre(a.box)[axis], at_b = centre(b.box)[axis];
                         return at_a < at_b || (at_a == at_b && a.item < b.item);
                     });
    return half;
}

/// Computes the box of node n from those of its slots, box_of_slot(slot), or of its children.
template <class Box, class BoxOfSlot>
Box refitted_box(const std::vector<BvhNode<Box>>& nodes, std::size_t n, const BoxOfSlot& box_of_slot) {
    const BvhNode<Box>& node = nodes[n];
    if (node.leaf == 0) {
        const BvhNode<Box>&one = nodes[n + 1], &other = nodes[one.skip];
        return {glm::min(one.min, other.min), glm::max(one.max, other.max)};
    }
    Box box = box_of_slot(node.first_slot());
    for (std::uint32_t i = 1; i < node.slots(); ++i) grow(box, box_of_slot(node.first_slot() + i));
    return box;
}

/// Finds the lowest value below node `root`, of a tree split by halve(). Branch and bound, more promising half first.
/// Returns `no_more_than` if no value is lower.
/// - rank(node) -> double: lower bound for all values below the node.
/// - value(leaf, lowest) -> double: the leaf's lowest value, or `lowest` where that is not larger.
template <class Box, class Rank, class Value>
double lowest_in_tree(const std::vector<BvhNode<Box>>& nodes, std::uint32_t root, double no_more_than, Rank&& rank,
                      Value&& value) {
    struct Waiting {
        std::uint32_t node;
        double rank;
    };
    // Halving 2^28 items leaves one after 28 steps; each step leaves at most one half to visit later.
    std::array<Waiting, 29> waiting;
    std::size_t count = 0;
    double lowest = no_more_than;
    waiting[count++] = {root, rank(nodes[root])};
    while (count > 0) {
        const Waiting next = waiting[--count];
        if (!(next.rank < lowest)) continue;
        if (nodes[next.node].leaf != 0) {
            lowest = value(nodes[next.node], lowest);
            continue;
        }
        const std::uint32_t one = next.node + 1, other = nodes[one].skip;
        Waiting nearer{one, rank(nodes[one])}, farther{other, rank(nodes[other])};
        if (farther.rank < nearer.rank) std::swap(nearer, farther);
        if (farther.rank < lowest) waiting[count++] = farther;
        if (nearer.rank < lowest) waiting[count++] = nearer;
    }
    return lowest;
}

}  // namespace gnomon::math
