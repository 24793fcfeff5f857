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

struct Part {
    Box box;
    std::uint32_t item = 0;
    glm::vec3 centre() const { return is_empty(box) ? glm::vec3(0.0f) : 0.5f * box.min + 0.5f * box.max; }
};

void grow(Box& box, const Box& other) { box = {glm::min(box.min, other.min), glm::max(box.max, other.max)}; }

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

class Builder {
public:
    Builder(std::span<const Box> boxes, std::uint32_t most_slots) : most_slots_(most_slots) {
        parts_.reserve(boxes.size());
        for (const Box& box : boxes) parts_.push_back({box, static_cast<std::uint32_t>(parts_.size())});
        bvh_.nodes.reserve(2 * boxes.size() / most_slots + 1);
    }
    Bvh take() {
        if (!parts_.empty()) make_node(0, static_cast<std::uint32_t>(parts_.size()), 0);
        for (const Part& part : parts_) bvh_.items.push_back(part.item);
        bvh_.nodes.shrink_to_fit();
        return std::move(bvh_);
    }

private:
    void make_node(std::uint32_t first, std::uint32_t end, int depth) {
        const auto index = static_cast<std::uint32_t>(bvh_.nodes.size());
        Box all, centres;
        for (std::uint32_t i = first; i < end; ++i) {
            grow(all, parts_[i].box);
            grow(centres, {parts_[i].centre(), parts_[i].centre()});
        }
        bvh_.nodes.push_back({all.min, 0, all.max, 0});
        const std::uint32_t count = end - first;
        const Cut cut = count > 1 ? best_cut(first, end, centres) : Cut{};
        const double area = half_area(all);
        const bool pays = cut.axis >= 0 && cut.cost + kNodeCost * area < static_cast<double>(count) * area;
        if (count <= most_slots_ && !pays) {
            bvh_.nodes[index].leaf = first * 16 + count;
        } else {
            const std::uint32_t middle =
                cut.axis >= 0 && depth < kMostUneven ? divide(first, end, centres, cut) : halve(first, end, centres);
            make_node(first, middle, depth + 1);
            make_node(middle, end, depth + 1);
        }
        bvh_.nodes[index].skip = static_cast<std::uint32_t>(bvh_.nodes.size());
    }

    static Binning binning(const Box& centres, int axis) {
        const float size = centres.max[axis] - centres.min[axis];
        const float per_m = static_cast<float>(kBins) / size;
        return {centres.min[axis], std::isfinite(per_m) && std::isfinite(size) ? per_m : 0.0f};
    }

    /// Finds the cut with the lowest sum of area times count over both sides. No axis if all centres fall into one bin.
    Cut best_cut(std::uint32_t first, std::uint32_t end, const Box& centres) const {
        std::array<std::array<Bin, kBins>, 3> bins{};
        const std::array<Binning, 3> bin_of{binning(centres, 0), binning(centres, 1), binning(centres, 2)};
        for (std::uint32_t i = first; i < end; ++i) {
            const glm::vec3 centre = parts_[i].centre();
            for (int axis = 0; axis < 3; ++axis) {
                Bin& bin = bins[static_cast<std::size_t>(axis)]
                               [static_cast<std::size_t>(bin_of[static_cast<std::size_t>(axis)](centre[axis]))];
                grow(bin.box, parts_[i].box);
                ++bin.count;
            }
        }
        Cut best;
        for (int axis = 0; axis < 3; ++axis) sweep(bins[static_cast<std::size_t>(axis)], axis, best);
        return best;
    }

    static void sweep(const std::array<Bin, kBins>& bins, int axis, Cut& best) {
        std::array<double, kBins> above{};  // cost of all bins from this one up
        Bin side;
        for (std::size_t b = kBins - 1; b > 0; --b) {
            grow(side.box, bins[b].box);
            side.count += bins[b].count;
            above[b] = half_area(side.box) * side.count;
        }
        const std::uint32_t all = side.count + bins[0].count;
        side = {};
        for (std::size_t b = 0; b + 1 < kBins; ++b) {
            grow(side.box, bins[b].box);
            side.count += bins[b].count;
            if (side.count == 0 || side.count == all) continue;
            const double cost = half_area(side.box) * side.count + above[b + 1];
            if (best.axis < 0 || cost < best.cost) best = {axis, static_cast<int>(b), cost};
        }
    }

    std::uint32_t divide(std::uint32_t first, std::uint32_t end, const Box& centres, const Cut& cut) {
        const Binning bin_of = binning(centres, cut.axis);
        const auto middle = std::partition(parts_.begin() + first, parts_.begin() + end, [&](const Part& part) {
            return bin_of(part.centre()[cut.axis]) <= cut.last;
        });
        return static_cast<std::uint32_t>(middle - parts_.begin());
    }

    std::uint32_t halve(std::uint32_t first, std::uint32_t end, const Box& centres) {
        const int axis = math::longest_side(glm::dvec3(centres.max) - glm::dvec3(centres.min));
        const std::uint32_t middle = first + (end - first) / 2;
        std::nth_element(parts_.begin() + first, parts_.begin() + middle, parts_.begin() + end,
                         [axis](const Part& a, const Part& b) {
                             const float at_a = a.centre()[axis], at_b = b.centre()[axis];
                             return at_a < at_b || (at_a == at_b && a.item < b.item);
                         });
        return middle;
    }

    std::vector<Part> parts_;
    Bvh bvh_;
    std::uint32_t most_slots_;
};

}  // namespace

Bvh build_bvh(std::span<const Box> boxes, std::uint32_t most_slots) { return Builder(boxes, most_slots).take(); }

void refit_bvh(std::vector<BvhNode>& nodes, std::span<const Box> box_of_slot) {
    for (std::size_t n = nodes.size(); n-- > 0;) {
        BvhNode& node = nodes[n];
        Box box;
        for (std::uint32_t slot = node.first_slot(); slot < node.first_slot() + node.slots(); ++slot)
            grow(box, box_of_slot[slot]);
        if (node.leaf == 0) {
            const BvhNode &one = nodes[n + 1], &other = nodes[one.skip];
            box = {glm::min(one.min, other.min), glm::max(one.max, other.max)};
        }
        node.min = box.min;
        node.max = box.max;
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
