#include "engine/math/shape_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "engine/math/lowest_in_tree.h"

namespace gnomon::math {
namespace {

/// Maximum number of parts in a leaf, if they lie close together. Distant parts (a wall and a floor) are split, because
/// the room between them is empty. Measured on Sponza: docs/culling.md, "Where seeing begins".
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
    glm::ivec3 end{0};

    Highest() = default;
    Highest(const glm::dvec3& g, double at_zero) : gradient(g), offset(at_zero), end(g.x > 0.0, g.y > 0.0, g.z > 0.0) {}
    double in(const glm::vec3 (&ends)[2]) const {
        const glm::dvec3 corner(ends[end.x].x, ends[end.y].y, ends[end.z].z);
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
    double operator()(const glm::vec3 (&ends)[2]) const {
        for (int axis = 0; axis < 3; ++axis)
            if (static_cast<double>(ends[0][axis]) > region_.max[axis] ||
                static_cast<double>(ends[1][axis]) < region_.min[axis])
                return kInfinity;
        for (std::size_t i = 0; i < count_; ++i)
            if (planes_[i].in(ends) < 0.0) return kInfinity;
        return -fall_.in(ends);
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

float extent(const glm::vec3& low, const glm::vec3& high) {
    const glm::vec3 size = high - low;
    return size.x + size.y + size.z;
}

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

ShapeTree::ShapeTree(std::vector<Box> parts) {
    if (parts.empty()) return;
    nodes_.emplace_back();
    make_node(0, parts);
    nodes_.shrink_to_fit();
}

/// Splits at the middle part along the longest side of the box of all centres.
void ShapeTree::make_node(std::uint32_t node, std::span<Box> parts) {
    Box all, centres;  // twice the centres
    for (const Box& part : parts) {
        all = {glm::min(all.min, part.min), glm::max(all.max, part.max)};
        centres = {glm::min(centres.min, part.min + part.max), glm::max(centres.max, part.min + part.max)};
    }
    nodes_[node] = {{all.min, all.max}, 0};
    const bool close = extent(all.min, all.max) <= kLeafShare * extent(nodes_[0].ends[0], nodes_[0].ends[1]);
    if (parts.size() <= (close ? kLeafParts : 1)) return;
    const int axis = longest_side(glm::dvec3(centres.max - centres.min));
    const auto middle = static_cast<std::ptrdiff_t>(parts.size() / 2);
    std::nth_element(parts.begin(), parts.begin() + middle, parts.end(), [axis](const Box& a, const Box& b) {
        return a.min[axis] + a.max[axis] < b.min[axis] + b.max[axis];
    });
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].children = children;
    make_node(children, parts.first(parts.size() / 2));
    make_node(children + 1, parts.subspan(parts.size() / 2));
}

double ShapeTree::lowest(const Ramp& ramp, std::span<const Plane> planes, double no_more_than,
                         std::vector<glm::dvec3>& scratch) const {
    if (empty() || planes.size() >= kMaxClipPlanes) return no_more_than;
    const auto box_of = [&](std::uint32_t n) {
        return Aabb{glm::dvec3(nodes_[n].ends[0]), glm::dvec3(nodes_[n].ends[1])};
    };
    Ranking ranking(box_of(0), ramp, planes);
    const auto rank = [&](std::uint32_t n) { return ranking(nodes_[n].ends); };
    const auto children = [&](std::uint32_t n) {
        const std::uint32_t first = nodes_[n].children;
        return first == 0 ? std::nullopt : std::optional(std::pair(first, first + 1));
    };
    return lowest_in_tree(no_more_than, rank, children, [&](std::uint32_t leaf, double lowest) {
        ranking.narrow(lowest, scratch);
        if (!(rank(leaf) < lowest)) return lowest;
        return lowest_in(box_of(leaf), ramp, planes, lowest, scratch);
    });
}

}  // namespace gnomon::math
