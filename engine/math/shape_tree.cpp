#include "engine/math/shape_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace gnomon::math {
namespace {

/// Maximum number of parts in a leaf, if they lie close together. Distant parts (a wall and a floor) are split, because
/// the room between them is empty. Measured on Sponza: docs/explanation/culling.md, "Where seeing begins".
constexpr std::size_t kLeafParts = 8;
constexpr float kLeafShare = 1.0f / 64.0f;  // largest leaf with several parts, relative to the shape
/// Rounding of a GPU's float coordinates: eight units in the last place. The basis, three products, their sums and the
/// subtraction of the anchor take seven. Rounding in double here is negligible beside it.
constexpr double kFloatRounding = 0x1p-21;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double rounding_in(const Aabb& box, const Ramp& ramp) {
    const glm::dvec3 farthest_abs = glm::max(glm::abs(box.min), glm::abs(box.max));
    return kFloatRounding * (glm::dot(glm::abs(ramp.gradient), farthest_abs) + std::abs(ramp.offset));
}

/// Maximum of dot(gradient, p) + offset over boxes. The gradient's signs fix which corner has it.
struct Highest {
    glm::dvec3 gradient{0.0};
    double offset = 0.0;
    glm::bvec3 end{false};  // true: at the box's max

    Highest() = default;
    Highest(const glm::dvec3& g, double at_zero) : gradient(g), offset(at_zero), end(g.x > 0.0, g.y > 0.0, g.z > 0.0) {}
    double in(const BvhNode<FloatBox>& node) const {
        const glm::dvec3 corner(end.x ? node.max.x : node.min.x, end.y ? node.max.y : node.min.y,
                                end.z ? node.max.z : node.min.z);
        return glm::dot(gradient, corner) + offset;
    }
};

/// lowest_corner() for many boxes within a common one, with one bound on rounding for all.
class Ranking {
public:
    Ranking(const Aabb& all, const Ramp& ramp, std::span<const Plane> planes)
        : all_(all),
          farthest_abs_(glm::max(glm::abs(all.min), glm::abs(all.max))),
          fall_(-ramp.gradient, -ramp.offset + rounding(ramp.gradient, ramp.offset)) {
        for (const Plane& plane : planes) {
            clips_[count_] = plane;
            planes_[count_++] = {plane.normal, plane.offset + rounding(plane.normal, plane.offset)};
        }
    }
    double operator()(const BvhNode<FloatBox>& node) const {
        for (int axis = 0; axis < 3; ++axis)
            if (static_cast<double>(node.min[axis]) > region_.max[axis] ||
                static_cast<double>(node.max[axis]) < region_.min[axis])
                return kInfinity;
        for (std::size_t i = 0; i < count_; ++i)
            if (planes_[i].in(node) < 0.0) return kInfinity;
        return -fall_.in(node);
    }
    /// Restricts the search to values below `lowest`, and thus to a smaller region inside the planes. Near the apex of
    /// a pyramid that excludes far more than testing the planes one by one.
    void narrow(double lowest, std::vector<glm::dvec3>& scratch) {
        if (lowest == narrowed_to_) return;
        narrowed_to_ = lowest;
        clips_[count_] = {fall_.gradient, fall_.offset + lowest};
        scratch.clear();
        clip_box(std::span(clips_).first(count_ + 1), all_, scratch);
        region_ = {};
        for (const glm::dvec3& p : scratch) region_ = extended(region_, p);
        region_ = {region_.min - kFloatRounding * farthest_abs_, region_.max + kFloatRounding * farthest_abs_};
    }

private:
    double rounding(const glm::dvec3& gradient, double offset) const {
        return kFloatRounding * (glm::dot(glm::abs(gradient), farthest_abs_) + std::abs(offset));
    }

    Aabb all_;
    glm::dvec3 farthest_abs_;
    Aabb region_{glm::dvec3(-kInfinity), glm::dvec3(kInfinity)};
    double narrowed_to_ = kInfinity;
    Highest fall_;
    std::array<Highest, kMaxClipPlanes> planes_;
    std::array<Plane, kMaxClipPlanes> clips_;
    std::size_t count_ = 0;
};

float extent(const FloatBox& box) {
    const glm::vec3 size = box.max - box.min;
    return size.x + size.y + size.z;
}

Aabb in_double(const FloatBox& box) { return {glm::dvec3(box.min), glm::dvec3(box.max)}; }

}  // namespace

double lowest_corner(const Aabb& box, const Ramp& ramp, std::span<const Plane> planes) {
    if (overlap(planes, box) == Overlap::outside) return kInfinity;
    const glm::dvec3 terms = glm::min(ramp.gradient * box.min, ramp.gradient * box.max);
    return terms.x + terms.y + terms.z + ramp.offset - rounding_in(box, ramp);
}

double lowest_in(const Aabb& box, const Ramp& ramp, std::span<const Plane> planes, double no_more_than,
                 std::vector<glm::dvec3>& scratch) {
    if (!(lowest_corner(box, ramp, planes) < no_more_than)) return no_more_than;
    scratch.clear();
    clip_box(planes, box, scratch);
    const double rounding = rounding_in(box, ramp);
    double lowest = no_more_than;
    for (const glm::dvec3& p : scratch) lowest = std::min(lowest, glm::dot(ramp.gradient, p) + ramp.offset - rounding);
    return lowest;
}

ShapeTree::ShapeTree(std::span<const FloatBox> parts) {
    std::vector<BvhItem<FloatBox>> items;  // without numbers, because leaves store their box alone
    items.reserve(parts.size());
    for (const FloatBox& part : parts) items.push_back({part});
    float size = 0.0f;
    append_nodes(nodes_, std::span(items), [&](std::span<BvhItem<FloatBox>> some, const FloatBox& box, int depth) {
        if (depth == 0) size = extent(box);
        const bool close = extent(box) <= kLeafShare * size;
        if (some.size() <= (close ? kLeafParts : 1)) return std::size_t{0};
        return halve(some, [](const FloatBox& part) { return part.min + part.max; });
    });
    nodes_.shrink_to_fit();
}

double ShapeTree::lowest(const Ramp& ramp, std::span<const Plane> planes, double no_more_than,
                         std::vector<glm::dvec3>& scratch) const {
    if (empty() || planes.size() >= kMaxClipPlanes) return no_more_than;
    Ranking rank(in_double(nodes_[0].box()), ramp, planes);
    return lowest_in_tree(nodes_, 0, no_more_than, rank, [&](const Node& leaf, double lowest) {
        rank.narrow(lowest, scratch);
        if (!(rank(leaf) < lowest)) return lowest;
        return lowest_in(in_double(leaf.box()), ramp, planes, lowest, scratch);
    });
}

}  // namespace gnomon::math
