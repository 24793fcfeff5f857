#pragma once
#include <array>
#include <span>
#include <vector>

#include "systems/shadow/frame/receiver_caster_sets.h"
#include "systems/shadow/projection/light_frusta.h"

namespace gnomon::shadow {

/// Moves the sides of a convex polygon out, by so much along each axis.
void widen(std::vector<glm::dvec2>& polygon, const glm::dvec2& by, SetScratch& scratch);

/// The four planes of an opening, through the light.
std::array<math::Plane, 4> opening_planes(const glm::dvec3& light_ws_m, const LightOpening& opening);

/// The beam to points of a sun: `axes` columns right, up, toward the light. Its outline is appended to `outlines`.
/// The points need not be inside of anything; there must be one.
Beam parallel_beam(const glm::dmat3& axes, std::span<const glm::dvec3> points_ws, std::vector<glm::dvec2>& outlines,
                   SetScratch& scratch);

/// The beam through an opening to points within it. Where points are so near the light that rounding hides their
/// direction, the outline is the whole opening; where all are as near as that, nothing can come between: far_m and
/// reach_m are 0, there is no outline.
Beam opening_beam(const glm::dvec3& light_ws_m, const LightOpening& opening, std::span<const glm::dvec3> points_ws,
                  std::vector<glm::dvec2>& outlines, SetScratch& scratch);

}  // namespace gnomon::shadow
