#include "engine/math/bounds_tree.h"

#include <bit>
#include <span>

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

void BoundsTree::build_nodes() {
    nodes_.clear();
    moved_.clear();
    const auto twice_centre = [](const Aabb& box) { return is_empty(box) ? glm::dvec3(0.0) : box.min + box.max; };
    append_nodes(nodes_, std::span(items_), [&](std::span<BvhItem<Aabb>> items, const Aabb&, int) {
        return items.size() <= kLeafSlots ? 0 : halve(items, twice_centre);
    });
    slot_of_.resize(items_.size());
    leaf_of_.resize(items_.size());
    parent_.resize(nodes_.size());
    built_extent_.resize(nodes_.size());
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
        const Node& node = nodes_[n];
        built_extent_[n] = extent(node.box());
        if (n == 0) parent_[n] = kNone;
        if (node.leaf == 0) parent_[n + 1] = parent_[nodes_[n + 1].skip] = n;
        for (std::uint32_t s = node.first_slot(); s < node.first_slot() + node.slots(); ++s) {
            slot_of_[items_[s].item] = s;
            leaf_of_[s] = n;
        }
    }
    growth_ = static_cast<double>(nodes_.size());
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
