#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

/// Perspective warp of the plane across the light, as in light-space perspective shadow maps (Wimmer et al. 2004). It
/// maps a point p to p / w with w = 1 + dot(gradient, p). Lengths are metres along a map's axes, from its anchor, where
/// the warp changes nothing. w does not depend on depth, so that it is constant along a ray. Gradient 0: no warp.
namespace gnomon::shadow {

inline double warp_w(const glm::dvec2& gradient, const glm::dvec2& p) { return 1.0 + glm::dot(gradient, p); }

/// Maps p into the warped plane. w must be above 0.
inline glm::dvec2 warped(const glm::dvec2& gradient, const glm::dvec2& p) { return p / warp_w(gradient, p); }

/// Maps q back from the warped plane. dot(gradient, q) must be below 1: points beyond have no preimage.
inline glm::dvec2 unwarped(const glm::dvec2& gradient, const glm::dvec2& q) {
    return q / (1.0 - glm::dot(gradient, q));
}

/// Returns the small displacement at p that becomes `step` in the warped plane: the inverse of the warp's derivative.
inline glm::dvec2 unwarped_step(const glm::dvec2& gradient, const glm::dvec2& p, const glm::dvec2& step) {
    return warp_w(gradient, p) * (step + p * glm::dot(gradient, step));
}

/// Returns an upper bound, metres, on the diagonals in the light's plane of a cell of the warped plane. It holds where
/// w is `w` and the warped point lies within `aside` of the line through the anchor along the gradient. `cell`: sides
/// of the cell along the axes. The bound is a convex function of w. Divided by the depth below a camera, it is
/// therefore largest at a corner of any convex part.
inline double longest_cell(const glm::dvec2& gradient, const glm::dvec2& cell, double aside, double w) {
    const double steepness = glm::length(gradient);
    const glm::dvec2 along = steepness > 0.0 ? gradient / steepness : glm::dvec2(1.0, 0.0);
    double longest = 0.0;
    for (const glm::dvec2 diagonal : {cell, glm::dvec2(cell.x, -cell.y)}) {
        const double forward = std::abs(glm::dot(along, diagonal));
        const double across = std::abs(along.x * diagonal.y - along.y * diagonal.x);
        longest = std::max(longest, std::hypot(w * w * forward, w * across + w * w * steepness * aside * forward));
    }
    return longest;
}

}  // namespace gnomon::shadow
