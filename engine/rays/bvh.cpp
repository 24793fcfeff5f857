#include "engine/rays/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::rays {
namespace {

constexpr int kBins = 16;
/// Cost of an inner node, in triangle tests. Costs from 1 to 4 differ by less than noise on Sponza (./gnomon bench
/// queries); 3 needs a quarter less memory than 1.
constexpr double kNodeCost = 3.0;
/// Depth from which nodes are cut into equal halves.
constexpr int kMostUneven = static_cast<int>(kMostDepth) - 28;

using Item = math::BvhItem<Box>;

glm::vec3 centre(const Box& box) { return is_empty(box) ? glm::vec3(0.0f) : 0.5f * box.min + 0.5f * box.max; }

double half_area(const Box& box) {
    if (is_empty(box)) return 0.0;
    const glm::dvec3 size = glm::dvec3(box.max) - glm::dvec3(box.min);
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

struct Bin {
    Box box;
    std::uint32_t count = 0;
};

/// Cut of a node in two: centres in bins up to `last` go to one side.
struct Cut {
    int axis = -1, last = 0;
    double cost = 0.0;
};

/// Maps a centre's coordinate along one axis to its bin; monotonic.
struct Binning {
    float from = 0.0f, per_m = 0.0f;
    int operator()(float at) const { return std::clamp(static_cast<int>((at - from) * per_m), 0, kBins - 1); }
};

Binning binning(const Box& centres, int axis) {
    const float size = centres.max[axis] - centres.min[axis];
    const float per_m = static_cast<float>(kBins) / size;
    return {centres.min[axis], std::isfinite(per_m) && std::isfinite(size) ? per_m : 0.0f};
}

void sweep(const std::array<Bin, kBins>& bins, int axis, Cut& best) {
    std::array<double, kBins> above{};  // cost of all bins from this one up
    Bin side;
    for (std::size_t b = kBins - 1; b > 0; --b) {
        math::grow(side.box, bins[b].box);
        side.count += bins[b].count;
        above[b] = half_area(side.box) * side.count;
    }
    const std::uint32_t all = side.count + bins[0].count;
    side = {};
    for (std::size_t b = 0; b + 1 < kBins; ++b) {
        math::grow(side.box, bins[b].box);
        side.count += bins[b].count;
        if (side.count == 0 || side.count == all) continue;
        const double cost = half_area(side.box) * side.count + above[b + 1];
        if (best.axis < 0 || cost < best.cost) best = {axis, static_cast<int>(b), cost};
    }
}

/// Finds the cut with the lowest sum of area times count over both sides. No axis if all centres fall into one bin.
Cut best_cut(std::span<const Item> items, const Box& centres) {
    std::array<std::array<Bin, kBins>, 3> bins{};
    const std::array<Binning, 3> bin_of{binning(centres, 0), binning(centres, 1), binning(centres, 2)};
    for (const Item& item : items) {
        const glm::vec3 at = centre(item.box);
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = bins[static_cast<std::size_t>(axis)]
                           [static_cast<std::size_t>(bin_of[static_cast<std::size_t>(axis)](at[axis]))];
            math::grow(bin.box, item.box);
            ++bin.count;
        }
    }
    Cut best;
    for (int axis = 0; axis < 3; ++axis) sweep(bins[static_cast<std::size_t>(axis)], axis, best);
    return best;
}

/// Splits by the surface area heuristic, or in halves where that finds nothing.
struct SurfaceAreaSplit {
    std::uint32_t most_slots;

    std::size_t operator()(std::span<Item> items, const Box& all, int depth) const {
        Box centres;
        for (const Item& item : items) math::grow(centres, {centre(item.box), centre(item.box)});
        const Cut cut = items.size() > 1 ? best_cut(items, centres) : Cut{};
        const double area = half_area(all);
        const bool pays = cut.axis >= 0 && cut.cost + kNodeCost * area < static_cast<double>(items.size()) * area;
        if (items.size() <= most_slots && !pays) return 0;
        if (cut.axis < 0 || depth >= kMostUneven) return math::halve(items, centre);
        const Binning bin_of = binning(centres, cut.axis);
        const auto middle = std::partition(items.begin(), items.end(), [&](const Item& item) {
            return bin_of(centre(item.box)[cut.axis]) <= cut.last;
        });
        return static_cast<std::size_t>(middle - items.begin());
    }
};

}  // namespace

Bvh build_bvh(std::span<const Box> boxes, std::uint32_t most_slots) {
    std::vector<Item> items;
    items.reserve(boxes.size());
    for (const Box& box : boxes) items.push_back({box, static_cast<std::uint32_t>(items.size())});
    Bvh bvh;
    bvh.nodes.reserve(2 * boxes.size() / most_slots + 1);
    math::append_nodes(bvh.nodes, std::span(items), SurfaceAreaSplit{most_slots});
    bvh.nodes.shrink_to_fit();
    bvh.items.reserve(items.size());
    for (const Item& item : items) bvh.items.push_back(item.item);
    return bvh;
}

void refit_bvh(std::vector<BvhNode>& nodes, std::span<const Box> box_of_slot) {
    for (std::size_t n = nodes.size(); n-- > 0;) {
        const Box box = math::refitted_box(nodes, n, [&](std::uint32_t slot) { return box_of_slot[slot]; });
        nodes[n].min = box.min;
        nodes[n].max = box.max;
    }
}

BvhCost cost_of(std::span<const BvhNode> nodes) {
    BvhCost cost;
    if (nodes.empty()) return cost;
    const double root = half_area({nodes[0].min, nodes[0].max});
    if (!(root > 0.0)) return {static_cast<double>(nodes.size()), 0.0};
    for (const BvhNode& node : nodes) {
        const double share = half_area({node.min, node.max}) / root;
        cost.nodes += share;
        cost.triangles += share * node.slots();
    }
    return cost;
}

}  // namespace gnomon::rays
