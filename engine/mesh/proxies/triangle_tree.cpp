#include "engine/mesh/proxies/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace gnomon::assets {
namespace {

constexpr double kNowhere_m = std::numeric_limits<double>::infinity();
constexpr std::size_t kLeaf = 4;  // most triangles of a leaf

/// Returns the squared distance to the nearest point of a segment.
double segment_distance2(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
    const glm::dvec3 along = b - a;
    const double length2 = glm::dot(along, along);
    const double at = length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec3 off = a + at * along - p;
    return glm::dot(off, off);
}

}  // namespace

double distance_to(const TriangleCorners& t, const glm::dvec3& p) {
    double least = std::min(
        {segment_distance2(t[0], t[1], p), segment_distance2(t[1], t[2], p), segment_distance2(t[2], t[0], p)});
    const glm::dvec3 ab = t[1] - t[0], ac = t[2] - t[0], normal = glm::cross(ab, ac), ap = p - t[0];
    const double area2 = glm::dot(normal, normal);
    if (area2 > 0.0) {  // the perpendicular's foot, as a mean of the corners, is a point of the triangle
        const double at_b = glm::dot(glm::cross(ap, ac), normal) / area2;
        const double at_c = glm::dot(glm::cross(ab, ap), normal) / area2;
        if (at_b >= 0.0 && at_c >= 0.0 && at_b + at_c <= 1.0) {
            const glm::dvec3 off = at_b * ab + at_c * ac - ap;
            least = std::min(least, glm::dot(off, off));
        }
    }
    return std::sqrt(least);
}

TriangleTree::TriangleTree(std::vector<TriangleCorners> triangles, std::vector<std::uint32_t> groups)
    : triangles_(std::move(triangles)), groups_(std::move(groups)) {
    std::vector<math::BvhItem<math::Aabb>> items;
    items.reserve(triangles_.size());
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        math::Aabb box;
        for (const glm::dvec3& corner : triangles_[i]) box = math::extended(box, corner);
        items.push_back({box, i});
    }
    math::append_nodes<math::Aabb>(nodes_, items, [](auto part, const math::Aabb&, int) {
        if (part.size() <= kLeaf) return std::size_t{0};
        return math::halve(part, [](const math::Aabb& box) { return math::centre(box); });
    });
    for (const auto& item : items) order_.push_back(item.item);
}

NearTriangle TriangleTree::nearest(const glm::dvec3& p, double limit_m, const std::vector<bool>& left_out) const {
    NearTriangle near{kNowhere_m, 0};
    if (nodes_.empty()) return near;
    const auto rank = [&](const math::BvhNode<math::Aabb>& node) { return math::distance(node.box(), p); };
    math::lowest_in_tree(nodes_, 0, limit_m, rank, [&](const math::BvhNode<math::Aabb>& leaf, double lowest) {
        for (std::uint32_t s = leaf.first_slot(); s < leaf.first_slot() + leaf.slots(); ++s) {
            const std::uint32_t i = order_[s];
            if (!left_out.empty() && left_out[groups_.empty() ? 0 : groups_[i]]) continue;
            const double distance_m = distance_to(triangles_[i], p);
            if (!(distance_m < lowest)) continue;
            lowest = distance_m;
            near = {distance_m, i};
        }
        return lowest;
    });
    return near;
}

}  // namespace gnomon::assets
