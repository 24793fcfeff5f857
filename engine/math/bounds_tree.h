#pragma once
#include <cstdint>
#include <vector>

#include "engine/math/aabb.h"
#include "engine/math/frustum.h"
#include "engine/math/lowest_in_tree.h"

namespace gnomon::math {

/// Binary tree over the boxes of numbered items, for finding all items that touch a volume. Results never depend on the
/// tree's shape, only the cost does. Moving items keeps the shape and refits the boxes; a tree that became loose is
/// rebuilt. Storage is reused: a tree allocates only when its item count exceeds all earlier ones.
class BoundsTree {
public:
    /// Builds the tree: item i below `count` has box_of(i). Equal input gives an equal tree. O(n log n). Items with an
    /// empty box are never found.
    template <class BoxOf>
    void build(std::uint32_t count, BoxOf&& box_of) {
        scratch_.clear();
        for (std::uint32_t i = 0; i < count; ++i) scratch_.push_back(box_of(i));
        build_from_scratch();
    }

    /// Replaces the box of item i < size(). Takes effect with refit().
    void move(std::uint32_t item, const Aabb& box);
    /// Applies moves. Costs nothing without moves; otherwise the depth of the tree per moved item, at most the whole
    /// tree once.
    void refit();

    std::size_t size() const { return items_.size(); }
    /// Returns the box around all items; empty without any.
    Aabb box() const { return nodes_.empty() ? Aabb{} : nodes_.front().box; }

    /// Calls visit(item) for each item with a box that is not `outside`, in no particular order. classify(box) ->
    /// Overlap must be consistent: parts of an `outside` box are outside, parts of an `inside` box inside.
    template <class Classify, class Visit>
    void visit(Classify&& classify, Visit&& visit) const {
        for (std::uint32_t n = 0; n < nodes_.size();) {
            const Node& node = nodes_[n];
            const Overlap overlap = classify(node.box);
            const bool leaf = node.next == n + 1;
            if (overlap == Overlap::inside) {
                for (std::uint32_t s = node.first_slot; s < node.end_slot; ++s)
                    if (!is_empty(boxes_[s])) visit(items_[s]);
            } else if (overlap == Overlap::partial && leaf) {
                for (std::uint32_t s = node.first_slot; s < node.end_slot; ++s)
                    if (classify(boxes_[s]) != Overlap::outside) visit(items_[s]);
            }
            n = overlap == Overlap::partial ? n + 1 : node.next;
        }
    }

    /// Returns the lowest value of any item; infinity without items. rank(box) -> double is a lower bound for all items
    /// in the box. value(item, lowest) -> double is the item's value, or `lowest` where that is not larger.
    template <class Rank, class Value>
    double lowest(Rank&& rank, Value&& value) const {
        constexpr double kNone = std::numeric_limits<double>::infinity();
        if (nodes_.empty()) return kNone;
        const auto rank_of = [&](std::uint32_t n) { return rank(nodes_[n].box); };
        const auto children = [&](std::uint32_t n) {
            const bool leaf = nodes_[n].next == n + 1;
            return leaf ? std::nullopt : std::optional(std::pair(n + 1, nodes_[n + 1].next));
        };
        return lowest_in_tree(kNone, rank_of, children, [&](std::uint32_t leaf, double lowest) {
            for (std::uint32_t s = nodes_[leaf].first_slot; s < nodes_[leaf].end_slot; ++s)
                if (rank(boxes_[s]) < lowest) lowest = value(items_[s], lowest);
            return lowest;
        });
    }

private:
    /// Node in preorder, first child first. `next` is the first node after its subtree.
    struct Node {
        Aabb box;
        std::uint32_t first_slot, end_slot, next, parent;
    };
    void build_from_scratch();
    void make_node(std::uint32_t first_slot, std::uint32_t end_slot, std::uint32_t parent);
    Aabb box_around(std::uint32_t node) const;
    bool refit_node(std::uint32_t node);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> items_;    // items in the order of the leaves, by slot
    std::vector<Aabb> boxes_;             // by slot
    std::vector<std::uint32_t> slot_of_;  // by item
    std::vector<std::uint32_t> leaf_of_;  // leaf node by slot
    std::vector<double> built_extent_;    // by node
    std::vector<std::uint32_t> moved_;    // slots since the last refit
    std::vector<Aabb> scratch_;           // by item, used while building
    double growth_ = 0.0;                 // sum over all nodes of extent relative to the built one
};

}  // namespace gnomon::math
