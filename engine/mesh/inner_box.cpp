#include "engine/mesh/inner_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "engine/math/aabb.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/mesh_weld.h"

namespace gnomon::assets {
namespace {

struct Triangle {
    std::array<glm::dvec3, 3> corners;
    math::Aabb bounds;
};

/// Lines along each axis that look for the inside, per side of their grid.
constexpr int kLines = 4;
/// Place of a line in its cell of the grid, in cells: not where models have their edges.
constexpr std::array kInCell = {0.5413, 0.4727};
/// Share of the part's size that a box's sides stay away from its triangles, for rounding.
constexpr double kApart = 0x1p-16;
/// Share of the part's size below which a box's side is not worth its tests.
constexpr double kLeastSide = 0.02;

math::Aabb bounds_of(std::span<const glm::dvec3> points) {
    math::Aabb bounds;
    for (const glm::dvec3& point : points) bounds = math::extended(bounds, point);
    return bounds;
}

double six_volumes(const std::array<glm::dvec3, 3>& t, const glm::dvec3& origin) {
    return glm::dot(t[0] - origin, glm::cross(t[1] - origin, t[2] - origin));
}

/// Returns the triangles of the part with the largest volume. Parts share no vertex.
std::vector<Triangle> largest_part(const Mesh& mesh) {
    const std::vector<std::uint32_t> welded = weld_by_position(mesh.vertices);
    DisjointSets sets(welded.size());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        for (const std::size_t next : {i + 1, i + 2}) sets.unite(welded[mesh.indices[i]], welded[mesh.indices[next]]);
    const auto corners = [&](std::size_t i) {
        const auto corner = [&](std::size_t c) { return glm::dvec3(mesh.vertices[mesh.indices[c]].position_ms); };
        return std::array<glm::dvec3, 3>{corner(i), corner(i + 1), corner(i + 2)};
    };
    const auto part_of = [&](std::size_t i) { return sets.find(welded[mesh.indices[i]]); };
    const glm::dvec3 origin = math::centre(mesh.bounds_ms);
    std::vector<double> volumes(welded.size(), 0.0);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) volumes[part_of(i)] += six_volumes(corners(i), origin);
    const auto largest = static_cast<std::uint32_t>(std::max_element(volumes.begin(), volumes.end()) - volumes.begin());
    std::vector<Triangle> part;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        if (part_of(i) == largest) part.push_back({corners(i), bounds_of(corners(i))});
    return part;
}

/// Segment along an axis, inside of a part.
struct Inside {
    int axis = 0;
    glm::dvec3 from{0.0};
    double length = 0.0;
};

/// Finds the longest piece inside of the part on a line along an axis. A line that passes too near to an edge has none.
Inside longest_on(std::span<const Triangle> part, int axis, const glm::dvec3& through, double size) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    struct Crossing {
        double at;
        int steps_in;
    };
    std::vector<Crossing> crossings;
    for (const Triangle& t : part) {
        const math::Aabb& box = t.bounds;
        if (through[u] < box.min[u] || through[u] > box.max[u] || through[v] < box.min[v] || through[v] > box.max[v])
            continue;
        std::array<double, 3> sides{};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 p = t.corners[k] - through, q = t.corners[(k + 1) % 3] - through;
            sides[k] = p[u] * q[v] - p[v] * q[u];
        }
        const double least = std::min({sides[0], sides[1], sides[2]}), most = std::max({sides[0], sides[1], sides[2]});
        const double slack = kApart * size * size;
        if (least < -slack && most > slack) continue;     // beside the triangle
        if (least <= slack && most >= -slack) return {};  // near an edge
        const double sum = sides[0] + sides[1] + sides[2];
        const auto along = [&](std::size_t k) { return t.corners[k][axis]; };
        crossings.push_back(
            {(sides[1] * along(0) + sides[2] * along(1) + sides[0] * along(2)) / sum, sum < 0.0 ? 1 : -1});
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.at < b.at; });
    Inside longest{axis, through, 0.0};
    int depth = 0;
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
        depth += crossings[i].steps_in;
        const double length = crossings[i + 1].at - crossings[i].at;
        if (depth < 1 || length <= longest.length) continue;
        longest.from[axis] = crossings[i].at;
        longest.length = length;
    }
    return longest;
}

/// Finds the longest piece inside of the part over a grid of lines along an axis.
Inside longest_along(std::span<const Triangle> part, const math::Aabb& bounds, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const glm::dvec3 extent = bounds.max - bounds.min;
    const double size = std::max({extent.x, extent.y, extent.z});
    Inside longest;
    for (int i = 0; i < kLines * kLines; ++i) {
        glm::dvec3 through = bounds.min;
        through[u] += extent[u] * (i % kLines + kInCell[0]) / kLines;
        through[v] += extent[v] * (i / kLines + kInCell[1]) / kLines;
        const Inside found = longest_on(part, axis, through, size);
        if (found.length > longest.length) longest = found;
    }
    return longest;
}

/// Cuts a polygon by the half-space of points with p[axis] at least, or at most, `limit`.
void cut(std::vector<glm::dvec3>& polygon, int axis, double limit, bool at_least, std::vector<glm::dvec3>& scratch) {
    scratch.clear();
    const auto inside = [&](const glm::dvec3& p) { return at_least ? p[axis] >= limit : p[axis] <= limit; };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if (inside(a)) scratch.push_back(a);
        if (inside(a) != inside(b)) scratch.push_back(a + (b - a) * ((limit - a[axis]) / (b[axis] - a[axis])));
    }
    polygon.swap(scratch);
}

/// Returns how far a side of the box may move outward: to the nearest triangle before it.
double free_until(const math::Aabb& box, int axis, bool high, std::span<const Triangle> part,
                  const math::Aabb& bounds) {
    double limit = high ? bounds.max[axis] : bounds.min[axis];
    const auto before = [&](double at) { return high ? at < limit : at > limit; };
    std::vector<glm::dvec3> polygon, scratch;
    for (const Triangle& t : part) {
        math::Aabb swept = box;
        (high ? swept.max : swept.min)[axis] = limit;
        if (!math::overlaps(swept, t.bounds)) continue;
        polygon.assign(t.corners.begin(), t.corners.end());
        for (int k = 0; k < 3; ++k) {
            cut(polygon, k, swept.min[k], true, scratch);
            cut(polygon, k, swept.max[k], false, scratch);
        }
        for (const glm::dvec3& p : polygon)
            if (before(p[axis])) limit = p[axis];
    }
    return limit;
}

/// Shares of their free way that the sides of a box move in turn. A side that took all at once would leave corners in
/// round rooms no room on the other sides.
constexpr std::array kSteps = {0.4, 0.4, 1.0};

/// Grows a box around the middle of a piece inside of the part. Empty: a triangle is too near.
math::Aabb grown_around(const Inside& inside, std::span<const Triangle> part, const math::Aabb& bounds) {
    const glm::dvec3 extent = bounds.max - bounds.min;
    const double apart = kApart * std::max({extent.x, extent.y, extent.z});
    math::Aabb box{inside.from - apart, inside.from + apart};
    box.min[inside.axis] = inside.from[inside.axis] + 0.4 * inside.length;
    box.max[inside.axis] = inside.from[inside.axis] + 0.6 * inside.length;
    for (const double step : kSteps)
        for (const int axis : {(inside.axis + 1) % 3, (inside.axis + 2) % 3, inside.axis})
            for (const bool high : {false, true}) {
                double& side = (high ? box.max : box.min)[axis];
                const double until = free_until(box, axis, high, part, bounds) + (high ? -2.0 : 2.0) * apart;
                const bool moves = high ? until > side : until < side;
                side = moves ? side + step * (until - side) : until;
                if (!(box.min[axis] < box.max[axis])) return {};
            }
    return box;
}

double surface(const math::Aabb& box) {
    const glm::dvec3 side = box.max - box.min;
    return side.x * side.y + side.y * side.z + side.z * side.x;
}

}  // namespace

math::Aabb inner_box(const Mesh& mesh) {
    if (!mesh.topology.outward || mesh.indices.size() / 3 > kMostInnerTriangles) return {};
    const std::vector<Triangle> part = largest_part(mesh);
    math::Aabb bounds;
    for (const Triangle& t : part) bounds = math::merged(bounds, t.bounds);
    math::Aabb largest;
    for (int axis = 0; axis < 3; ++axis) {
        const Inside inside = longest_along(part, bounds, axis);
        if (!(inside.length > 0.0)) continue;
        const math::Aabb box = grown_around(inside, part, bounds);
        if (math::is_empty(box) || (!math::is_empty(largest) && surface(box) <= surface(largest))) continue;
        const glm::dvec3 side = box.max - box.min, least = kLeastSide * (bounds.max - bounds.min);
        if (glm::all(glm::greaterThan(side, least))) largest = box;
    }
    return largest;
}

}  // namespace gnomon::assets
