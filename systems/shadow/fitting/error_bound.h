#pragma once
#include <glm/vec3.hpp>
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_view.h"

/// How far a shadow edge may be off in the picture, told before anything is drawn.
///
/// A map knows the light at texel centres alone. Where a receiver is looked up, the centre lies up to half a texel away
/// (E for a filter that looks E texels around: the footprint's half-width); the offset that keeps the receiver's plane
/// from shadowing itself (docs/bias.md) is worth another E texels of slope. So on a receiver's plane an edge is off by
/// no more than
///     (1/2 + E) m + 1 pixels,
/// m being the longest extent of a texel there, in pixels: of its diagonals, carried along the light's ray onto the
/// plane and from there into the picture. The pixel is half of one each for the true and the drawn picture, which know
/// their edges between pixel centres only. Derived for the hard filter, E = 1/2; held against it by
/// tests/gl/truth_edges_gl_test.cpp at every place of a true edge.
///
/// Exceptions, by name, and no others:
/// - `sub_texel_caster`: the shadow, or the light beside it, is thinner than a texel there, or its caster is nearer to
///   the receiver than the receiver's own rise over the texel, or than the depth format tells apart there
///   (told_apart_m): a map may miss such a thing altogether.
/// - `truth_ambiguous`: which surface is seen, or whether the light reaches it, hangs on less than the rasteriser's
///   snapping or the last digits of the position.
/// Assumed: the bias is Gnomon's own, not a manual BiasMode.
namespace gnomon::shadow {

/// A texel's sides across the light at a point, metres.
struct TexelSides {
    glm::dvec3 u_m{0.0}, v_m{0.0};
};
TexelSides texel_sides(const ShadowView& view, const glm::dvec3& p_ws);

/// How far a caster has to stand before a surface at p_ws, along the ray, so that fixed-point depths tell it from the
/// surface: two steps of the format, one that what is stored may be off by and one by which the bias makes up for it. 0
/// of floats, whose steps are a share of the distance. Of a warped map, at its anchor.
double told_apart_m(const ShadowView& view, DepthFormat format, const glm::dvec3& p_ws);

/// Longest extent of one texel on screen, in pixels, on a plane through p_ws with unit normal `normal` (Lloyd et al.
/// 2006 call it m): the texel's diagonals, carried along the light's ray onto the plane and from there into the
/// picture. Infinite where the plane holds the ray, or p_ws is not in front of the consumer or (perspective views) of
/// the light.
double texel_extent_px(const ShadowView& view, const ConsumerItem& consumer, const glm::dvec3& p_ws,
                       const glm::dvec3& normal);

/// What the view states, slope by slope, so that it holds everywhere: ShadowView::predicted_error_px for receivers that
/// face the light within 60 degrees; on steeper ones the texel's share of it grows as 1 / cosine (of the normal to the
/// way to the light). No less than edge_error_px of any visible receiver point that the view serves.
double stated_error_px(const ShadowView& view, double cosine, double reach_texel);

/// The bound over all receivers of a view, `points_ws` being corners of convex parts of what is seen of them; those
/// outside a perspective view do not count. All 0 if nothing is in front of the consumer.
ViewError predict_error(const ShadowView& view, const ConsumerItem& consumer, std::span<const glm::dvec3> points_ws,
                        double reach_texel);

/// Raises what the view states of itself (texel_m, texel_extent_px, predicted_error_px, metre_px) to that bound.
void state_error(const ConsumerItem& consumer, std::span<const glm::dvec3> points_ws, double reach_texel,
                 ShadowView& view);

}  // namespace gnomon::shadow
