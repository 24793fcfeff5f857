#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace gnomon::math {

/// Finds the lowest value in a binary tree of fewer than 2^32 items, node 0 being its root. Branch and bound, more
/// promising half first. Returns `no_more_than` if no value is lower.
/// - rank(node) -> double: lower bound for all values below the node.
/// - children(node) -> optional pair of nodes: nothing at a leaf.
/// - value(leaf, lowest) -> double: the leaf's lowest value, or `lowest` where that is not larger.
template <class Rank, class Children, class Value>
double lowest_in_tree(double no_more_than, Rank&& rank, Children&& children, Value&& value) {
    struct Waiting {
        std::uint32_t node;
        double rank;
    };
    // Halving 2^32 items leaves one after 32 steps; each step leaves at most one half to visit later.
    std::array<Waiting, 33> waiting;
    std::size_t count = 0;
    double lowest = no_more_than;
    waiting[count++] = {0, rank(0u)};
    while (count > 0) {
        const Waiting next = waiting[--count];
        if (!(next.rank < lowest)) continue;
        const std::optional<std::pair<std::uint32_t, std::uint32_t>> halves = children(next.node);
        if (!halves) {
            lowest = value(next.node, lowest);
            continue;
        }
        Waiting nearer{halves->first, rank(halves->first)}, farther{halves->second, rank(halves->second)};
        if (farther.rank < nearer.rank) std::swap(nearer, farther);
        if (farther.rank < lowest) waiting[count++] = farther;
        if (nearer.rank < lowest) waiting[count++] = nearer;
    }
    return lowest;
}

}  // namespace gnomon::math
