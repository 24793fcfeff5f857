#pragma once
#include <array>
#include <span>
#include <vector>

#include "systems/shadow/frame/receiver_caster_sets.h"
#include "systems/shadow/projection/light_frusta.h"

namespace gnomon::shadow {

/// Moves the sides of a convex polygon outward, by `by` along each axis.
void widen(std::vector<glm::dvec2>& polygon, const glm::dvec2& by, SetScratch& scratch);

/// Returns the four side planes of a light frustum.
std::array<math::Plane, 4> frustum_planes(const glm::dvec3& light_ws_m, const LightFrustum& frustum);

/// Computes a sun's receiver hull around `points_ws`, at least one, and appends its polygon to `outlines`. `axes`:
/// columns right, up, toward the light.
ReceiverHull directional_hull(const glm::dmat3& axes, std::span<const glm::dvec3> points_ws,
                              std::vector<glm::dvec2>& outlines, SetScratch& scratch);

/// Computes the receiver hull around points within a light frustum, and appends its polygon to `outlines`. Where
/// rounding hides the direction of points near the light, the polygon is the whole frustum. Where all points are as
/// near as that, no caster fits between: far_m and reach_m are 0, and there is no polygon.
ReceiverHull frustum_hull(const glm::dvec3& light_ws_m, const LightFrustum& frustum,
                          std::span<const glm::dvec3> points_ws, std::vector<glm::dvec2>& outlines,
                          SetScratch& scratch);

}  // namespace gnomon::shadow
