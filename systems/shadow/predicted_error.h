#pragma once
#include <glm/vec3.hpp>
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/types.h"

/// How far a shadow edge may be off, told before anything is drawn.
namespace gnomon::shadow {

/// Longest extent of one texel on screen, in pixels, on a plane through p_ws with unit normal `normal` (Lloyd et al.
/// 2006 call it m): the texel's diagonals, carried along the light's ray onto the plane and from there into the
/// picture. Infinite where the plane holds the ray, or p_ws is not in front of the consumer or (perspective views) of
/// the light.
double texel_extent_px(const ShadowView& view, const ConsumerItem& consumer, const glm::dvec3& p_ws,
                       const glm::dvec3& normal);

/// The displacement that follows: half the texel by sampling at its centre, `reach_texel` of it by the offset that
/// keeps the plane from shadowing itself, and half a pixel each for the true and the drawn picture.
double edge_error_px(double extent_px, double reach_texel);

/// Receivers are taken to face the light within 60 degrees: there a texel is at most 1 / cos 60° = 2 times as long on
/// them as across the light. Steeper ones show longer edges, in dimmer light.
inline constexpr double kSteepestReceiver = 2.0;

struct ViewError {
    double texel_m = 0.0;    // largest diagonal of a texel across the light, at a receiver
    double extent_px = 0.0;  // Lloyd's m, largest over the receivers
    double edge_px = 0.0;
};

/// The bound over all receivers of a view, `points_ws` being corners of convex parts of what is seen of them; those
/// outside a perspective view do not count. All 0 if nothing is in front of the consumer.
ViewError predict_error(const ShadowView& view, const ConsumerItem& consumer, std::span<const glm::dvec3> points_ws,
                        double reach_texel);

}  // namespace gnomon::shadow
