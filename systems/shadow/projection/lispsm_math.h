#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

/// A perspective warp across the light: the point p of the light's plane goes to p / w with w = 1 + dot(gradient, p).
/// Lengths are metres along a map's axes, from its anchor; there the warp changes nothing. Depth is not part of it, so
/// that all of a ray has one w. No gradient: no warp.
namespace gnomon::shadow {

inline double warp_w(const glm::dvec2& gradient, const glm::dvec2& p) { return 1.0 + glm::dot(gradient, p); }

/// Where p goes. w > 0.
inline glm::dvec2 warped(const glm::dvec2& gradient, const glm::dvec2& p) { return p / warp_w(gradient, p); }

/// What goes to q. dot(gradient, q) < 1: beyond lies nothing.
inline glm::dvec2 unwarped(const glm::dvec2& gradient, const glm::dvec2& q) {
    return q / (1.0 - glm::dot(gradient, q));
}

/// The small displacement at p that becomes `step` in the warped plane: the inverse of the warp's derivative.
inline glm::dvec2 unwarped_step(const glm::dvec2& gradient, const glm::dvec2& p, const glm::dvec2& step) {
    return warp_w(gradient, p) * (step + p * glm::dot(gradient, step));
}

/// The most metres that either diagonal of a cell of the warped plane covers in the light's plane, wherever w is `w`
/// and the warped point lies within `aside` of the line through the anchor along the gradient. `cell`: its sides along
/// the axes. A convex function of w, so that over the depth below a camera it is largest at a corner of any convex
/// part.
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
