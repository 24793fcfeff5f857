#include "engine/math/bounds_tree.h"

#include <algorithm>
#include <bit>

namespace gnomon::math {
namespace {

/// Number of slots in a leaf. Sizes 4 to 8 cost the same within noise, 1 and 16 cost more (./gnomon bench culling).
constexpr std::uint32_t kLeafSlots = 4;
/// Growth at which the tree is rebuilt: mean over all nodes of their extent relative to the built one. Each node counts
/// at most kMostGrowth, so that one outlier does not decide.
constexpr double kLooseGrowth = 2.0, kMostGrowth = 16.0;

/// Computes the sum of the sides; 0 if empty.
double extent(const Aabb& box) {
    return is_empty(box) ? 0.0 : (box.max.x - box.min.x) + (box.max.y - box.min.y) + (box.max.z - box.min.z);
}

double growth(double extent_now, double extent_built) {
    if (!(extent_now > extent_built)) return 1.0;
    return extent_now < kMostGrowth * extent_built ? extent_now / extent_built : kMostGrowth;
}

}  // namespace

Aabb BoundsTree::box() const {
    Aabb all;
    for (std::uint32_t root = 0; root < nodes_.size(); root = nodes_[root].skip) grow(all, nodes_[root].box());
    return all;
}

/// Builds one tree over all items that were not removed.
void BoundsTree::build_nodes() {
    nodes_.clear();
    trees_.clear();
    leaf_of_.clear();
    moved_.clear();
    growth_ = 0.0;
    append_tree();
}

/// Builds a tree over the items that are in none, and over those of earlier trees less than twice as large. Sizes then
/// fall by halves, and an item is built again a logarithm of times.
void BoundsTree::append_tree() {
    std::size_t first = leaf_of_.size();
    while (!trees_.empty() && first - trees_.back().first_slot < 2 * (items_.size() - first)) {
        const Tree last = trees_.back();
        for (std::size_t n = last.first_node; n < nodes_.size(); ++n)
            growth_ -= growth(extent(nodes_[n].box()), built_extent_[n]);
        first = last.first_slot;
        nodes_.resize(last.first_node);
        trees_.pop_back();
    }
    const auto begin = items_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = std::remove_if(begin, items_.end(), [](const auto& item) { return item.item == kNone; });
    removed_ -= static_cast<std::size_t>(items_.end() - end);
    items_.erase(end, items_.end());
    leaf_of_.resize(items_.size());
    if (first == items_.size()) return;
    const auto root = static_cast<std::uint32_t>(nodes_.size());
    trees_.push_back({root, static_cast<std::uint32_t>(first)});
    const auto twice_centre = [](const Aabb& box) { return is_empty(box) ? glm::dvec3(0.0) : box.min + box.max; };
    const auto split = [&](std::span<BvhItem<Aabb>> items, const Aabb&, int) {
        return items.size() <= kLeafSlots ? 0 : halve(items, twice_centre);
    };
    append_nodes(nodes_, std::span(items_).subspan(first), split, static_cast<std::uint32_t>(first));
    parent_.resize(nodes_.size());
    built_extent_.resize(nodes_.size());
    parent_[root] = kNone;
    for (std::uint32_t n = root; n < nodes_.size(); ++n) {
        const Node& node = nodes_[n];
        built_extent_[n] = extent(node.box());
        if (node.leaf == 0) parent_[n + 1] = parent_[nodes_[n + 1].skip] = n;
        for (std::uint32_t s = node.first_slot(); s < node.first_slot() + node.slots(); ++s) {
            slot_of_[items_[s].item] = s;
            leaf_of_[s] = n;
        }
    }
    growth_ += static_cast<double>(nodes_.size() - root);
}

/// Takes the removed items out and numbers the others in their order, with gaps for the added ones.
void BoundsTree::renumber(std::span<const std::uint32_t> removed, std::span<const std::uint32_t> added) {
    for (const std::uint32_t i : removed) {
        items_[slot_of_[i]] = {{}, kNone};
        moved_.push_back(slot_of_[i]);
    }
    list_moves(static_cast<std::uint32_t>(size()), removed, added, moves_);
    apply_moves<std::uint32_t>(moves_, size() - removed.size() + added.size(), slot_of_);
    for (const PlaceMove& move : moves_)
        for (std::uint32_t i = move.to; i < move.to + move.count; ++i) items_[slot_of_[i]].item = i;
    removed_ += removed.size();
    refit();
    if (removed_ * 2 > items_.size()) build_nodes();
}

/// Updates a node's box. Returns true if it changed.
bool BoundsTree::refit_node(std::uint32_t n) {
    const Aabb box = refitted_box(nodes_, n, [&](std::uint32_t slot) -> const Aabb& { return items_[slot].box; });
    const Aabb before = nodes_[n].box();
    if (box == before) return false;
    growth_ += growth(extent(box), built_extent_[n]) - growth(extent(before), built_extent_[n]);
    nodes_[n].min = box.min;
    nodes_[n].max = box.max;
    return true;
}

void BoundsTree::move(std::uint32_t item, const Aabb& box) {
    const std::uint32_t slot = slot_of_[item];
    if (items_[slot].box == box) return;
    items_[slot].box = kept(box);
    moved_.push_back(slot);
}

void BoundsTree::refit() {
    if (moved_.empty()) return;
    if (moved_.size() * std::bit_width(nodes_.size()) < nodes_.size()) {
        for (const std::uint32_t slot : moved_)
            for (std::uint32_t n = leaf_of_[slot]; n != kNone && refit_node(n);) n = parent_[n];
    } else {
        for (auto n = static_cast<std::uint32_t>(nodes_.size()); n-- > 0;) refit_node(n);
    }
    moved_.clear();
    if (growth_ > kLooseGrowth * static_cast<double>(nodes_.size())) build_nodes();
}

}  // namespace gnomon::math
