#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/core/place_moves.h"
#include "engine/math/bvh.h"
#include "engine/math/frustum.h"

namespace gnomon::math {

/// Binary trees over the boxes of numbered items, for finding all items that touch a volume. Results never depend on
/// the trees' shape, only the cost does. Moving items keeps the shape and refits the boxes; trees that became loose are
/// rebuilt as one. Items that are added get trees of their own, each built with at most half as many as the one before
/// it. Storage is reused: no call allocates unless it needs more items than all earlier ones.
class BoundsTree {
public:
    /// Builds the tree: item i below `count` has box_of(i). Equal input gives an equal tree. O(n log n). Items with an
    /// empty box are never found.
    template <class BoxOf>
    void build(std::uint32_t count, BoxOf&& box_of) {
        items_.clear();
        removed_ = 0;
        for (std::uint32_t i = 0; i < count; ++i) items_.push_back({kept(box_of(i)), i});
        slot_of_.resize(count);
        build_nodes();
    }

    /// Removes and adds items, and renumbers all in their order. `removed`: numbers before, rising. `added`: numbers
    /// after, rising and below the new size; they have box_of(i). Applies earlier moves as well. O(items between
    /// the first and the last change) for the numbers. Added items cost a logarithm of the size each, in the mean over
    /// many calls.
    template <class BoxOf>
    void splice(std::span<const std::uint32_t> removed, std::span<const std::uint32_t> added, BoxOf&& box_of) {
        renumber(removed, added);
        for (const std::uint32_t i : added) items_.push_back({kept(box_of(i)), i});
        if (!added.empty()) append_tree();
    }

    /// Replaces the box of item i < size(). Takes effect with refit().
    void move(std::uint32_t item, const Aabb& box);
    /// Applies moves. Costs nothing without moves; otherwise the depth of the tree per moved item, at most the whole
    /// tree once.
    void refit();

    std::size_t size() const { return slot_of_.size(); }
    /// Returns the box around all items; empty without any.
    Aabb box() const;

    /// Calls visit(item) for each item with a box that is not `outside`, in no particular order. classify(box) ->
    /// Overlap must be consistent: parts of an `outside` box are outside, parts of an `inside` box inside.
    template <class Classify, class Visit>
    void visit(Classify&& classify, Visit&& visit) const {
        for (std::uint32_t n = 0; n < nodes_.size();) {
            const Node& node = nodes_[n];
            const Overlap overlap = classify(node.box());
            if (overlap == Overlap::inside) {
                for (std::uint32_t s = first_slot(n), end = end_slot(n); s < end; ++s)
                    if (!is_empty(items_[s].box)) visit(items_[s].item);
            } else if (overlap == Overlap::partial) {
                for (std::uint32_t s = node.first_slot(); s < node.first_slot() + node.slots(); ++s)
                    if (items_[s].item != kNone && classify(items_[s].box) != Overlap::outside) visit(items_[s].item);
            }
            n = overlap == Overlap::partial ? n + 1 : node.skip;
        }
    }

    /// Does the same with tests that parts of a box inherit. classify(box, open) -> Overlap clears the bits of tests
    /// that no part of the box needs, in its copy of what the box around it left. `open`: the tests at the root.
    template <class Classify, class Visit>
    void visit(OpenTests open, Classify&& classify, Visit&& visit) const {
        struct Around {
            std::uint32_t end;  // first node after the subtree
            OpenTests open;
        };
        std::array<Around, kMostDepth + 1> around;
        std::size_t depth = 0;
        around[0] = {static_cast<std::uint32_t>(nodes_.size()), open};
        for (std::uint32_t n = 0; n < nodes_.size();) {
            while (n >= around[depth].end) --depth;
            const Node& node = nodes_[n];
            OpenTests left = around[depth].open;
            const Overlap overlap = classify(node.box(), left);
            if (overlap == Overlap::inside) {
                for (std::uint32_t s = first_slot(n), end = end_slot(n); s < end; ++s)
                    if (!is_empty(items_[s].box)) visit(items_[s].item);
            } else if (overlap == Overlap::partial) {
                for (std::uint32_t s = node.first_slot(); s < node.first_slot() + node.slots(); ++s) {
                    OpenTests of_item = left;
                    if (items_[s].item != kNone && classify(items_[s].box, of_item) != Overlap::outside)
                        visit(items_[s].item);
                }
                if (node.leaf == 0) around[++depth] = {node.skip, left};
            }
            n = overlap == Overlap::partial ? n + 1 : node.skip;
        }
    }

    /// Returns how many numbers lowest_by_number() gives to nodes and items, from 0 on.
    std::size_t numbers() const { return nodes_.size() + items_.size(); }

    /// Returns the lowest value of any item, as lowest(), with rank(box, number) and value(item, lowest, number).
    /// Callers can keep by number what they know of a box. Numbers stay until the tree changes.
    template <class Rank, class Value>
    double lowest_by_number(Rank&& rank, Value&& value) const {
        double lowest = std::numeric_limits<double>::infinity();
        const auto rank_of = [&](const Node& node) {
            return rank(node.box(), static_cast<std::uint32_t>(&node - nodes_.data()));
        };
        const auto first = static_cast<std::uint32_t>(nodes_.size());
        for (std::uint32_t root = 0; root < nodes_.size(); root = nodes_[root].skip)
            lowest = lowest_in_tree(nodes_, root, lowest, rank_of, [&](const Node& leaf, double least) {
                for (std::uint32_t s = leaf.first_slot(); s < leaf.first_slot() + leaf.slots(); ++s)
                    if (items_[s].item != kNone && rank(items_[s].box, first + s) < least)
                        least = value(items_[s].item, least, first + s);
                return least;
            });
        return lowest;
    }

    /// Returns the lowest value of any item; infinity without items. rank(box) -> double is a lower bound for all items
    /// in the box. value(item, lowest) -> double is the item's value, or `lowest` where that is not larger.
    template <class Rank, class Value>
    double lowest(Rank&& rank, Value&& value) const {
        double lowest = std::numeric_limits<double>::infinity();
        const auto rank_of = [&](const Node& node) { return rank(node.box()); };
        for (std::uint32_t root = 0; root < nodes_.size(); root = nodes_[root].skip)
            lowest = lowest_in_tree(nodes_, root, lowest, rank_of, [&](const Node& leaf, double least) {
                for (std::uint32_t s = leaf.first_slot(); s < leaf.first_slot() + leaf.slots(); ++s)
                    if (items_[s].item != kNone && rank(items_[s].box) < least) least = value(items_[s].item, least);
                return least;
            });
        return lowest;
    }

private:
    using Node = BvhNode<Aabb>;
    struct Tree {
        std::uint32_t first_node, first_slot;
    };

    /// Returns the box as the tree keeps it: without NaN.
    static Aabb kept(const Aabb& box) { return is_empty(box) ? Aabb{} : box; }
    void build_nodes();
    void append_tree();
    void renumber(std::span<const std::uint32_t> removed, std::span<const std::uint32_t> added);
    bool refit_node(std::uint32_t node);
    /// Finds the range of slots below a node, which has no gaps. The last node of a subtree is a leaf.
    std::uint32_t first_slot(std::uint32_t node) const {
        while (nodes_[node].leaf == 0) ++node;
        return nodes_[node].first_slot();
    }
    std::uint32_t end_slot(std::uint32_t node) const {
        const Node& last = nodes_[nodes_[node].skip - 1];
        return last.first_slot() + last.slots();
    }

    static constexpr std::uint32_t kNone = 0xffffffffu;
    static constexpr std::size_t kMostDepth = 29;  // halving 2^28 items leaves one after 28 steps

    std::vector<Node> nodes_;             // tree after tree
    std::vector<Tree> trees_;             // by rising node and slot
    std::vector<BvhItem<Aabb>> items_;    // by slot; kNone with an empty box: a removed item
    std::vector<std::uint32_t> slot_of_;  // by item
    std::vector<PlaceMove> moves_;        // scratch: items with another number after a splice
    std::size_t removed_ = 0;             // slots of removed items
    std::vector<std::uint32_t> leaf_of_;  // leaf node by slot
    std::vector<std::uint32_t> parent_;   // by node
    std::vector<double> built_extent_;    // by node
    std::vector<std::uint32_t> moved_;    // slots since the last refit
    double growth_ = 0.0;                 // sum over all nodes of extent relative to the built one
};

}  // namespace gnomon::math
