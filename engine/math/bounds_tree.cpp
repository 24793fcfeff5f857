#include "engine/math/bounds_tree.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace gnomon::math {
namespace {

/// Number of slots in a leaf. Sizes 4 to 8 cost the same within noise, 1 and 16 cost more (./gnomon bench culling).
constexpr std::uint32_t kLeafSlots = 4;
constexpr std::uint32_t kNone = 0xffffffffu;
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

void BoundsTree::build_from_scratch() {
    const auto count = static_cast<std::uint32_t>(scratch_.size());
    items_.resize(count);
    std::iota(items_.begin(), items_.end(), 0u);
    boxes_.resize(count);
    slot_of_.resize(count);
    leaf_of_.resize(count);
    nodes_.clear();
    built_extent_.clear();
    moved_.clear();
    if (count == 0) return;
    make_node(0, count, kNone);
    for (const Node& node : nodes_) built_extent_.push_back(extent(node.box));
    growth_ = static_cast<double>(nodes_.size());
}

/// Splits at the middle item along the longest side of the box of all centres. Equal centres are ordered by item
/// number. The order is then unique, and does not depend on how nth_element arranges the halves.
void BoundsTree::make_node(std::uint32_t first_slot, std::uint32_t end_slot, std::uint32_t parent) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, first_slot, end_slot, 0, parent});
    const auto begin = items_.begin() + first_slot, end = items_.begin() + end_slot;
    if (end_slot - first_slot <= kLeafSlots) {
        std::sort(begin, end);
        for (std::uint32_t s = first_slot; s < end_slot; ++s) {
            boxes_[s] = scratch_[items_[s]];
            slot_of_[items_[s]] = s;
            leaf_of_[s] = index;
        }
        nodes_[index].next = index + 1;
    } else {
        Aabb centres;
        for (auto i = begin; i != end; ++i)
            if (!is_empty(scratch_[*i])) centres = extended(centres, centre(scratch_[*i]));
        const int axis = longest_side(is_empty(centres) ? glm::dvec3(0.0) : centres.max - centres.min);
        const auto key = [&](std::uint32_t item) {
            const Aabb& box = scratch_[item];
            return is_empty(box) ? std::numeric_limits<double>::infinity() : box.min[axis] + box.max[axis];
        };
        const std::uint32_t middle = first_slot + (end_slot - first_slot) / 2;
        std::nth_element(begin, items_.begin() + middle, end, [&](std::uint32_t a, std::uint32_t b) {
            const double key_a = key(a), key_b = key(b);
            return key_a < key_b || (key_a == key_b && a < b);
        });
        make_node(first_slot, middle, index);
        make_node(middle, end_slot, index);
        nodes_[index].next = static_cast<std::uint32_t>(nodes_.size());
    }
    nodes_[index].box = box_around(index);
}

Aabb BoundsTree::box_around(std::uint32_t n) const {
    const Node& node = nodes_[n];
    Aabb box;
    if (node.next == n + 1) {
        for (std::uint32_t s = node.first_slot; s < node.end_slot; ++s) box = merged(box, boxes_[s]);
        return box;
    }
    return merged(nodes_[n + 1].box, nodes_[nodes_[n + 1].next].box);
}

/// Updates a node's box. Returns true if it changed.
bool BoundsTree::refit_node(std::uint32_t n) {
    const Aabb box = box_around(n);
    Node& node = nodes_[n];
    if (box == node.box) return false;
    growth_ += growth(extent(box), built_extent_[n]) - growth(extent(node.box), built_extent_[n]);
    node.box = box;
    return true;
}

void BoundsTree::move(std::uint32_t item, const Aabb& box) {
    const std::uint32_t slot = slot_of_[item];
    if (boxes_[slot] == box) return;
    boxes_[slot] = box;
    moved_.push_back(slot);
}

void BoundsTree::refit() {
    if (moved_.empty()) return;
    if (moved_.size() * std::bit_width(nodes_.size()) < nodes_.size()) {
        for (const std::uint32_t slot : moved_)
            for (std::uint32_t n = leaf_of_[slot]; n != kNone && refit_node(n);) n = nodes_[n].parent;
    } else {
        for (auto n = static_cast<std::uint32_t>(nodes_.size()); n-- > 0;) refit_node(n);
    }
    moved_.clear();
    if (growth_ <= kLooseGrowth * static_cast<double>(nodes_.size())) return;
    scratch_.resize(items_.size());
    for (std::uint32_t s = 0; s < items_.size(); ++s) scratch_[items_[s]] = boxes_[s];
    build_from_scratch();
}

}  // namespace gnomon::math
