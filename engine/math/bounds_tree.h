#pragma once
#include <cstdint>
#include <vector>

#include "engine/math/aabb.h"
#include "engine/math/frustum.h"
#include "engine/math/lowest_in_tree.h"

namespace gnomon::math {

/// Boxes of numbered items in a binary tree, to find those that touch a volume without looking at all of them.
/// What is found never depends on the tree's shape, only its cost does. Moving items keeps the shape and refits the
/// boxes; when that has made the tree loose, it is built again. Storage is kept, so that nothing is allocated once as
/// many items have been held before.
class BoundsTree {
public:
    /// Item i, below count, has box_of(i). Equal input gives an equal tree. O(n log n). An empty box is never found.
    template <class BoxOf>
    void build(std::uint32_t count, BoxOf&& box_of) {
        scratch_.clear();
        for (std::uint32_t i = 0; i < count; ++i) scratch_.push_back(box_of(i));
        build_from_scratch();
    }

    /// Item i < size() now has another box. Takes effect with refit().
    void move(std::uint32_t item, const Aabb& box);
    /// Costs nothing if nothing moved; else the depth of the tree for each moved item, at most once over the tree.
    void refit();

    std::size_t size() const { return items_.size(); }
    /// Around all boxes; empty without any.
    Aabb box() const { return nodes_.empty() ? Aabb{} : nodes_.front().box; }

    /// Calls visit(item) for each item whose box does not lie outside, in no particular order.
    /// classify(box) -> Overlap; it must not say `outside` of a box of which it says otherwise for a part, nor `inside`
    /// of one of which it says otherwise for a part.
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

    /// The lowest value of any item; infinite without one. rank(box) -> double, no more than the value of any item in
    /// the box; value(item, lowest) -> double, or `lowest` where the item's is none the lower.
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
    /// In the order of a walk that takes the first child first: it follows its parent, and `next` is the node after all
    /// that is below.
    struct Node {
        Aabb box;
        std::uint32_t first_slot, end_slot, next, parent;
    };
    void build_from_scratch();
    void make_node(std::uint32_t first_slot, std::uint32_t end_slot, std::uint32_t parent);
    Aabb box_around(std::uint32_t node) const;
    bool refit_node(std::uint32_t node);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> items_;    // by slot: places of the items in the order of the leaves
    std::vector<Aabb> boxes_;             // by slot
    std::vector<std::uint32_t> slot_of_;  // by item
    std::vector<std::uint32_t> leaf_of_;  // by slot: the node
    std::vector<double> built_extent_;    // by node
    std::vector<std::uint32_t> moved_;    // slots since the last refit
    std::vector<Aabb> scratch_;           // by item, while building
    double growth_ = 0.0;                 // over all nodes: extent against the built one
};

}  // namespace gnomon::math
