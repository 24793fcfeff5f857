#include "engine/math/inner_hull.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "engine/math/finite.h"

namespace gnomon::math {
namespace {

/// Distance from a plane that counts as on it, as a share of the hull's size: a thousand roundings.
constexpr double kSlack = 0x1p-43;
/// Least height of the first tetrahedron, as a share of the hull's size: a thousand slacks.
constexpr double kLeastHeight = 0x1p-33;

/// Returns the index of the point with the largest value.
template <class Value>
std::size_t farthest(std::span<const glm::dvec3> points, const Value& value) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
        if (value(points[i]) > value(points[best])) best = i;
    return best;
}

}  // namespace

void InnerHull::add_facet(std::span<const glm::dvec3> points, std::size_t a, std::size_t b, std::size_t c) {
    const glm::dvec3 normal = glm::cross(points[b] - points[a], points[c] - points[a]);
    facets_.push_back({{a, b, c}, normal, glm::dot(normal, points[a])});
}

/// Makes the first tetrahedron. Returns false if the points lie in a plane.
bool InnerHull::start(std::span<const glm::dvec3> points) {
    bounds_ = {};
    for (const glm::dvec3& p : points) bounds_ = extended(bounds_, p);
    const double size = glm::length(bounds_.max - bounds_.min);
    const double largest = glm::length(glm::max(glm::abs(bounds_.min), glm::abs(bounds_.max)));
    slack_ = kSlack * largest;
    const std::size_t a = farthest(points, [](const glm::dvec3& p) { return -p.x; });
    const std::size_t b = farthest(points, [&](const glm::dvec3& p) { return glm::distance(p, points[a]); });
    const glm::dvec3 along = points[b] - points[a];
    const std::size_t c =
        farthest(points, [&](const glm::dvec3& p) { return glm::length(glm::cross(along, p - points[a])); });
    const glm::dvec3 normal = glm::cross(along, points[c] - points[a]);
    const std::size_t d =
        farthest(points, [&](const glm::dvec3& p) { return std::abs(glm::dot(normal, p - points[a])); });
    const double height = glm::dot(normal, points[d] - points[a]);
    if (!(std::abs(height) > std::max(kLeastHeight * size, 2.0 * slack_) * glm::length(normal))) return false;
    const std::size_t first = height < 0.0 ? b : c, second = height < 0.0 ? c : b;
    add_facet(points, a, first, second);
    add_facet(points, a, second, d);
    add_facet(points, second, first, d);
    add_facet(points, first, a, d);
    return true;
}

/// Replaces the facets that the point sees by facets from their outline to it.
void InnerHull::add(std::span<const glm::dvec3> points, std::size_t point) {
    edges_.clear();
    const auto seen = [&](const Facet& f) {
        return glm::dot(f.normal, points[point]) - f.offset > slack_ * glm::length(f.normal);
    };
    for (const Facet& f : facets_) {
        if (!seen(f)) continue;
        for (int i = 0; i < 3; ++i) edges_.push_back({f.corners[i], f.corners[(i + 1) % 3]});
    }
    if (edges_.empty()) return;
    std::erase_if(facets_, seen);
    for (const Edge& edge : edges_) {
        const auto is_back = [&](const Edge& other) { return other.from == edge.to && other.to == edge.from; };
        if (std::none_of(edges_.begin(), edges_.end(), is_back)) add_facet(points, edge.from, edge.to, point);
    }
}

/// Returns whether each edge of a facet is one of exactly one other, the other way round.
bool InnerHull::is_closed() {
    edges_.clear();
    for (const Facet& f : facets_)
        for (int i = 0; i < 3; ++i) edges_.push_back({f.corners[i], f.corners[(i + 1) % 3]});
    std::sort(edges_.begin(), edges_.end());
    const bool repeats = std::adjacent_find(edges_.begin(), edges_.end()) != edges_.end();
    return !repeats && std::all_of(edges_.begin(), edges_.end(), [&](const Edge& edge) {
        return std::binary_search(edges_.begin(), edges_.end(), Edge{edge.to, edge.from});
    });
}

/// Returns whether no point lies beyond a facet. Facets that close up around all points are those of their hull.
bool InnerHull::holds(std::span<const glm::dvec3> points) const {
    return std::all_of(facets_.begin(), facets_.end(), [&](const Facet& f) {
        const double most = f.offset + 2.0 * slack_ * glm::length(f.normal);
        return std::all_of(points.begin(), points.end(),
                           [&](const glm::dvec3& p) { return glm::dot(f.normal, p) <= most; });
    });
}

void InnerHull::build(std::span<const glm::dvec3> points) {
    facets_.clear();
    normals_.clear();
    offsets_.clear();
    points = points.first(std::min(points.size(), kMostPoints));
    if (points.size() < 4 || !std::all_of(points.begin(), points.end(), [](const auto& p) { return is_finite(p); }))
        return;
    if (!start(points)) return;
    for (std::size_t i = 0; i < points.size(); ++i) add(points, i);
    if (!is_closed() || !holds(points)) return;
    for (const Facet& f : facets_) {
        normals_.push_back(f.normal);
        offsets_.push_back(f.offset);
    }
}

bool InnerHull::contains(const Aabb& box, std::size_t& last_facet) const {
    if (normals_.empty() || is_empty(box)) return false;
    if (glm::any(glm::lessThan(box.min, bounds_.min)) || glm::any(glm::greaterThan(box.max, bounds_.max))) return false;
    const glm::dvec3 middle = centre(box), half = half_extent(box);
    const auto is_beyond = [&](std::size_t i) {
        const glm::dvec3& n = normals_[i];
        return !(glm::dot(n, middle) + glm::dot(glm::abs(n), half) <= offsets_[i]);
    };
    if (last_facet < normals_.size() && is_beyond(last_facet)) return false;
    for (std::size_t i = 0; i < normals_.size(); ++i) {
        if (!is_beyond(i)) continue;
        last_facet = i;
        return false;
    }
    return true;
}

}  // namespace gnomon::math
