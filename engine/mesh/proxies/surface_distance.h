#pragma once
#include <span>

#include "engine/mesh/proxies/triangle_tree.h"

/// Proven bounds on how far surfaces lie apart.
///
/// The distance to one triangle is convex: over a triangle it is largest at a corner. The distance to a surface changes
/// by no more than the step between two points. Both bound the distance over a piece of a triangle. Pieces are
/// quartered until a bound is near what is found at some point.
namespace gnomon::assets {

/// Distance of a surface's farthest point from another surface, metres.
struct SurfaceDistance {
    double least_m = 0.0;  // found at a point
    double most_m = 0.0;   // no point is farther away
};

/// Bounds the distance of any point of `from` from the triangles of `to`. `slack_m`: how far apart the two bounds may
/// end, beside half of the lower one. Infinite where `to` has no triangles, or where the proof would take too long, as
/// between large flat surfaces.
SurfaceDistance surface_distance(std::span<const TriangleCorners> from, const TriangleTree& to, double slack_m);

/// Returns true if every point of `from` is proven to lie within `limit_m` of the triangles of `to` in groups without a
/// flag in `left_out`.
bool lies_within(std::span<const TriangleCorners> from, const TriangleTree& to, double limit_m,
                 const std::vector<bool>& left_out);

}  // namespace gnomon::assets
