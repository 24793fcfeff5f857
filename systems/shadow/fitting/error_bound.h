#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_view.h"

/// Bound on how far a shadow edge may be off on the screen, known before anything is drawn.
///
/// A map samples the light at texel centres only. A receiver's lookup is up to half a texel away from the centre, or E
/// for a filter of radius E texels. The bias that keeps the receiver's plane from shadowing itself
/// (docs/explanation/bias.md) is worth another E texels of slope. So on a receiver's plane an edge is off by no more
/// than
///     (1/2 + E) m + 1 pixels.
/// m is the longest extent of a texel on the screen, pixels. It is the longer diagonal, projected along the light's ray
/// onto the plane and from there to the screen. The added pixel is half of one each for the true and the drawn image,
/// which know their edges between pixel centres only. Derived for the hard filter, E = 1/2.
/// tests/gl/truth_edges_gl_test.cpp compares it with every true edge.
///
/// Exceptions, by name, and no others:
/// - `sub_texel_caster`: the shadow, or the light beside it, is thinner than a texel there. Or the caster is nearer to
///   the receiver than the receiver's own rise over the texel, or than the depth format resolves
///   (min_resolvable_gap_m). A map may miss such a thing altogether.
/// - `truth_ambiguous`: the visible surface, or its visibility from the light, depends on less than the rasteriser's
///   snapping or the last digits of the position.
///
/// Assumes Gnomon's own bias, not a manual BiasMode.
namespace gnomon::shadow {

/// Sides of a texel across the light at a point, metres.
struct TexelSides {
    glm::dvec3 u_m{0.0}, v_m{0.0};
};
TexelSides texel_sides(const ShadowView& view, const glm::dvec3& p_ws);

/// Returns the least distance, along the ray, from a caster to a surface at p_ws that fixed-point depths resolve,
/// metres. It is two steps of the format: the stored depth may be off by one, and the bias makes up for another. 0 for
/// floats: their steps are a share of the distance. In a warped map it holds at the anchor.
double min_resolvable_gap_m(const ShadowView& view, DepthFormat format, const glm::dvec3& p_ws);

/// Returns the longest extent of one texel on screen, pixels, on a plane through p_ws with unit normal `normal` (m of
/// Lloyd et al. 2006). Projects the texel's diagonals along the light's ray onto the plane and from there to the
/// screen. Infinite where the plane contains the ray, or where p_ws is behind the camera or (perspective views) the
/// light.
double texel_extent_px(const ShadowView& view, const ConsumerItem& consumer, const glm::dvec3& p_ws,
                       const glm::dvec3& normal);

/// Returns the error bound that the view states for receivers with this cosine between normal and direction to the
/// light, pixels. It is ViewError::texel_edge_px within 60 degrees. Beyond, the texel's share grows as 1 / cosine. No
/// visible receiver point that the view serves has a larger edge_error_px.
double stated_error_px(const ShadowView& view, double cosine, double reach_texel);

/// Raises the error that the view states (ViewError) to the bound over all its receivers. `points_ws`: corners of
/// convex parts of what is seen of them; points outside a perspective view do not count.
void state_error(const ConsumerItem& consumer, std::span<const glm::dvec3> points_ws, double reach_texel,
                 ShadowView& view);

/// Sum over points from which a mean follows.
struct ExtentSum {
    double log2_px = 0.0;
    std::uint64_t points = 0;
};
/// Adds the extents of a texel on screen at the points that state_error() bounds. Their geometric mean is what is
/// usual, where the bound is that of the worst place.
void add_extents(const ConsumerItem& consumer, std::span<const glm::dvec3> points_ws, const ShadowView& view,
                 ExtentSum& sum);

/// Returns what the view states of its maps.
MapAccuracy accuracy_of(const ShadowView& view);

/// States the bound on the error of edges of casters that the view resolves (ViewError::edge_px). `walks`: its filter
/// walks the triangles of all of its casters; otherwise texels decide.
void state_edges(bool walks, ShadowView& view);

}  // namespace gnomon::shadow
