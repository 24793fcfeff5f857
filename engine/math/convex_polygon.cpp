#include "engine/math/convex_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace gnomon::math {
namespace {

/// Computes twice the signed area of the triangle, positive if it turns left.
double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// From this number of points on, finding the outermost points first is cheaper than sorting all.
constexpr std::size_t kManyPoints = 64;

/// Moves the points that are not clearly inside the octagon to the front and returns them.
std::span<glm::dvec2> outer_points(std::span<glm::dvec2> points) {
    // Outermost toward low x, low x + y, low y, low y - x, and their opposites.
    std::array<glm::dvec2, 8> outermost;
    std::array<double, 4> low, high;
    outermost.fill(points.front());
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (const glm::dvec2& p : points) {
        const std::array<double, 4> at = {p.x, p.x + p.y, p.y, p.y - p.x};
        for (std::size_t i = 0; i < 4; ++i) {
            if (at[i] < low[i]) low[i] = at[i], outermost[i] = p;
            if (at[i] > high[i]) high[i] = at[i], outermost[i + 4] = p;
        }
    }
    // Half-planes dot(normal, p) > least, tightened so that rounding cannot make a point on the rim an inner one.
    constexpr double kRounding = 0x1p-50;
    std::array<glm::dvec3, 8> inside;  // normal, least
    std::size_t count = 0;
    const double size = std::max({-low[0], high[0], -low[2], high[2]});
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::dvec2 &a = outermost[i], along = outermost[(i + 1) % 8] - a, normal(-along.y, along.x);
        const double sides = std::abs(normal.x) + std::abs(normal.y);
        if (sides > 0.0) inside[count++] = {normal, glm::dot(normal, a) + kRounding * sides * size};
    }
    const auto outside = [&](const glm::dvec2& p) {
        for (std::size_t i = 0; i < count; ++i)
            if (!(inside[i].x * p.x + inside[i].y * p.y > inside[i].z)) return true;
        return false;
    };
    const auto kept = std::partition(points.begin(), points.end(), outside) - points.begin();
    return points.first(std::max<std::size_t>(static_cast<std::size_t>(kept), 1));  // none where all points are equal
}

}  // namespace

void convex_hull(std::span<glm::dvec2> points, std::vector<glm::dvec2>& hull) {
    hull.clear();
    if (points.empty()) return;
    if (points.size() >= kManyPoints) points = outer_points(points);
    std::sort(points.begin(), points.end(),
              [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    const auto extend = [&hull](const glm::dvec2& p, std::size_t floor) {
        while (hull.size() >= floor + 2 && !(cross(hull[hull.size() - 2], hull.back(), p) > 0.0)) hull.pop_back();
        hull.push_back(p);
    };
    for (const glm::dvec2& p : points) extend(p, 0);
    const std::size_t lower = hull.size() - 1;
    for (std::size_t i = points.size(); i-- > 0;) extend(points[i], lower);
    if (hull.size() > 1) hull.pop_back();
}

void drop_flat_corners(double tolerance, std::vector<glm::dvec2>& polygon, std::vector<glm::dvec2>& scratch) {
    if (polygon.size() < 2) return;
    const glm::dvec2 first = polygon.front();
    const auto squared = [](const glm::dvec2& v) { return glm::dot(v, v); };
    // The corner farthest from any given point is never a product of rounding.
    const auto start = std::max_element(polygon.begin(), polygon.end(), [&](const glm::dvec2& a, const glm::dvec2& b) {
        return squared(a - first) < squared(b - first);
    });
    std::rotate(polygon.begin(), start, polygon.end());
    scratch.swap(polygon);
    polygon.assign(1, scratch.front());
    const auto flat = [&](const glm::dvec2& p, const glm::dvec2& to) {
        const glm::dvec2 &from = polygon.back(), along = to - from;
        const double length_squared = squared(along);
        const double at = length_squared > 0.0 ? std::clamp(glm::dot(p - from, along) / length_squared, 0.0, 1.0) : 0.0;
        return squared(p - from - at * along) <= tolerance * tolerance;
    };
    std::size_t kept = 0;  // index in scratch of the last corner kept
    for (std::size_t i = 1; i < scratch.size(); ++i) {
        const glm::dvec2& next = scratch[(i + 1) % scratch.size()];
        bool all_flat = true;
        for (std::size_t k = kept + 1; all_flat && k <= i; ++k) all_flat = flat(scratch[k], next);
        if (all_flat) continue;
        polygon.push_back(scratch[i]);
        kept = i;
    }
}

void clip_polygon(const glm::dvec2& normal, double offset, std::vector<glm::dvec2>& polygon,
                  std::vector<glm::dvec2>& scratch) {
    scratch.swap(polygon);
    polygon.clear();
    for (std::size_t i = 0; i < scratch.size(); ++i) {
        const glm::dvec2 &a = scratch[i], &b = scratch[(i + 1) % scratch.size()];
        const double at_a = glm::dot(normal, a) + offset, at_b = glm::dot(normal, b) + offset;
        if (at_a >= 0.0) polygon.push_back(a);
        if ((at_a >= 0.0) != (at_b >= 0.0)) polygon.push_back(a + (b - a) * std::clamp(at_a / (at_a - at_b), 0.0, 1.0));
    }
}

}  // namespace gnomon::math
