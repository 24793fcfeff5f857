#include "engine/mesh/proxies/coarser_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "engine/math/aabb.h"
#include "engine/mesh/disjoint_sets.h"
#include "engine/mesh/proxies/edge_collapse.h"
#include "engine/mesh/proxies/surface_distance.h"

namespace gnomon::assets {
namespace {

/// Limits of the steps, as a share of the surface's diagonal: the first, and how many there are, each twice as wide. A
/// map of 2048 texels over the surface shows less than the first one. The last is the coarsest form of use.
constexpr double kFirstLimit = 1.0 / 2048.0;
constexpr int kSteps = 8;
/// Part of a step's limit by which a bound may exceed what was found.
constexpr double kSlack = 0.25;
/// Rounding of distances between doubles, as a share of the diagonal and the distance from the origin.
constexpr double kRounding = 1e-14;
/// Sizes between which the fourth powers of distances are doubles.
constexpr double kLeast_m = 1e-60, kMost_m = 1e60;

std::vector<TriangleCorners> triangles_of_faces(std::span<const glm::dvec3> points, std::span<const WeldedFace> faces) {
    std::vector<TriangleCorners> corners;
    corners.reserve(faces.size());
    for (const WeldedFace& f : faces) corners.push_back({points[f[0]], points[f[1]], points[f[2]]});
    return corners;
}

double diagonal_m(std::span<const TriangleCorners> triangles) {
    math::Aabb box;
    for (const TriangleCorners& triangle : triangles)
        for (const glm::dvec3& corner : triangle) box = math::extended(box, corner);
    return glm::distance(box.min, box.max);
}

/// Part of a surface, with faces that share vertices.
struct Part {
    std::uint32_t number = 0;
    double diagonal_m = 0.0;
    std::vector<TriangleCorners> triangles;
};

/// Marks the faces of parts within `limit_m` of parts that stay. Small parts go first.
std::vector<bool> near_parts(std::span<const glm::dvec3> points, std::span<const WeldedFace> faces, double limit_m) {
    DisjointSets sets(points.size());
    for (const WeldedFace& f : faces) {
        sets.unite(f[0], f[1]);
        sets.unite(f[1], f[2]);
    }
    const std::vector<std::uint32_t> firsts = sets.firsts();
    std::vector<std::uint32_t> part_of(points.size(), ~0u), groups;
    std::vector<Part> parts;
    const std::vector<TriangleCorners> triangles = triangles_of_faces(points, faces);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        std::uint32_t& part = part_of[firsts[faces[f][0]]];
        if (part == ~0u) {
            part = static_cast<std::uint32_t>(parts.size());
            parts.push_back({part, 0.0, {}});
        }
        groups.push_back(part);
        parts[part].triangles.push_back(triangles[f]);
    }
    std::vector<bool> left_out(parts.size(), false), dropped(faces.size(), false);
    if (parts.size() < 2) return dropped;
    const TriangleTree tree(triangles, groups);
    for (Part& part : parts) part.diagonal_m = diagonal_m(part.triangles);
    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
        return a.diagonal_m != b.diagonal_m ? a.diagonal_m < b.diagonal_m : a.number < b.number;
    });
    for (const Part& part : parts) {
        left_out[part.number] = true;  // alone it would be near itself
        left_out[part.number] = lies_within(part.triangles, tree, limit_m, left_out);
    }
    for (std::size_t f = 0; f < faces.size(); ++f) dropped[f] = left_out[groups[f]];
    return dropped;
}

}  // namespace

std::vector<CoarserSurface> coarser_surfaces(std::span<const glm::dvec3> points, std::span<const WeldedFace> faces) {
    std::vector<CoarserSurface> made;
    if (faces.size() < kLeastFaces) return made;
    const std::vector<TriangleCorners> whole = triangles_of_faces(points, faces);
    const double size_m = diagonal_m(whole);
    double farthest_m = 0.0;
    for (const TriangleCorners& triangle : whole)
        for (const glm::dvec3& corner : triangle) {
            if (!(glm::length(corner) < kMost_m)) return made;
            farthest_m = std::max(farthest_m, glm::length(corner));
        }
    if (!(size_m > kLeast_m)) return made;
    const double rounding_m = kRounding * (size_m + farthest_m);
    const TriangleTree whole_tree(whole);
    EdgeCollapse collapse(points, faces);
    std::size_t last = faces.size();
    double limit_m = kFirstLimit * size_m;
    for (int step = 0; step < kSteps; ++step, limit_m *= 2.0) {
        collapse.run(limit_m);
        collapse.drop(near_parts(points, collapse.faces(), limit_m));
        CoarserSurface coarser{collapse.faces(), 0.0, 0.0};
        if (static_cast<double>(coarser.faces.size()) > kProxyShare * static_cast<double>(last)) continue;
        const std::vector<TriangleCorners> coarse = triangles_of_faces(points, coarser.faces);
        const SurfaceDistance to = surface_distance(whole, TriangleTree(coarse), kSlack * limit_m);
        const SurfaceDistance back = surface_distance(coarse, whole_tree, kSlack * limit_m);
        coarser.found_m = std::max(to.least_m, back.least_m);
        coarser.bound_m = std::max(to.most_m, back.most_m) + rounding_m;
        if (!std::isfinite(coarser.bound_m)) break;
        last = coarser.faces.size();
        made.push_back(std::move(coarser));
        if (last < kLeastFaces) break;
    }
    // A form is of no use if a coarser one has no larger bound.
    for (std::size_t i = made.size(); i-- > 1;)
        if (made[i - 1].bound_m >= made[i].bound_m) made.erase(made.begin() + static_cast<std::ptrdiff_t>(i) - 1);
    return made;
}

}  // namespace gnomon::assets
