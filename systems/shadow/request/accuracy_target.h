#pragma once
#include <cstdint>
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"

/// Accuracy target: maps get the texels that LightShadow::max_error_px and narrowest_caster_px need, and no more.
///
/// The error of an edge that texels decide is (1/2 + E) m pixels, plus one pixel that the pixel grid causes by itself
/// (error_bound.h). m, the length of a texel on the screen, shrinks as the map's edge grows. So a fit with maps of any
/// size determines which size meets the target. A caster as wide as (1/2 + E) texels is resolved by the same map.
///
/// Where a filter walks the casters' own triangles, texels decide only which casters count. Its edges are exact within
/// kWalk_px. Its maps still follow max_error_px where narrowest_caster_px is not set.
///
/// Hysteresis keeps a walking camera from causing new maps often:
/// - Size: a map grows at once. It shrinks only after half of its edge has met the target for a second.
/// - Number of a sun's cascades: it rises where maps have to grow, or where the visible receivers take another step of
///   size. It falls only in every kMovesToCount-th frame in which maps move and are drawn anyway.
namespace gnomon::shadow {

/// Computes the bound on an edge's error, pixels, where texels are `extent_px` long on screen (error_bound.h).
/// `reach_texel`: E.
double edge_error_px(double extent_px, double reach_texel);

/// Stretch of a texel on the steepest receiver for which a view's error is stated: 1 / cos 60° = 2 against a texel
/// across the light. Steeper receivers show longer errors, in dimmer light. No single number bounds them, because every
/// curved surface has places at grazing incidence.
inline constexpr double kSteepestReceiver = 2.0;

/// Returns the stretch of a texel on a receiver, relative to the steepest receiver of the stated error. `cosine`: n·l
/// of the receiver. At least 1; infinite at grazing incidence.
double slope_factor(double cosine);

/// Least edge of a map, texels; edges are multiples of it. It is as large as a quantised grid needs, and so coarse that
/// a window that grows by some pixels seldom causes new maps.
inline constexpr std::uint32_t kLeastMap_px = 256;

/// Returns the width of a caster that a map resolves, texels' diagonals. `reach_texel`: E.
double resolved_width_texel(double reach_texel);

/// Bound on the error of edges of resolved casters, pixels, where a filter walks the casters' triangles. Walks find the
/// edge itself. Half a pixel is the picture's: it shows an edge between pixel centres. The rest covers what rounding
/// decides at corners (tests/gl/resolved_edges_gl_test.cpp).
inline constexpr double kWalk_px = 0.6;

/// Computes that bound where positions of surfaces are off by `rounding_px` on screen.
double walk_error_px(double rounding_px);

/// Computes the width on screen, at its receiver across the light, of a caster that a map resolves, pixels.
/// `texel_edge_px`: edge_error_px() of the map on the steepest receiver.
double resolved_px(double texel_edge_px);

/// Returns the bound on the error of a target, pixels: max_error_px, or 1 where that is not above 0.
double target_error_px(const LightShadow& shadow);

/// Returns the target for what texels decide, pixels: edge_error_px() beside the pixel grid's own. It follows
/// max_error_px, and narrowest_caster_px where that is set. `filter`: the light's own, which may need it for one of
/// them alone.
double texel_target_px(const LightShadow& shadow, ShadowFilter filter);

/// Returns the light's targets. Negative or NaN: 0.
AccuracyTargets targets_of(const LightShadow& shadow);

/// Returns true if maps meet the targets, apart from the pixel grid's own error. `share`: factor on both targets. NaN
/// meets none.
bool meets_targets(const MapAccuracy& maps, const AccuracyTargets& targets, double share = 1.0);

/// Returns true if the target may make the light's maps smaller than MapLimits::max_px. False where the size is given,
/// must not depend on visible receivers (ShadowFit::stable), or determines a filter's width (FilterWidth::source).
bool adapts_to_target(const LightItem& light, const ShadowRequest& request);

/// Computes the edge that maps of `size_px` with the error `predicted_px` should get, at most `most_px`. It is the
/// least multiple of kLeastMap_px with an error up to `target_px` beside the pixel grid's own.
/// `exists`: the maps do; they keep size_px unless it is too small, or at least twice the needed edge.
/// `predicted_px`: 0 if no receiver is visible. Infinite or NaN: returns most_px.
std::uint32_t target_size_px(std::uint32_t size_px, bool exists, double predicted_px, double target_px,
                             std::uint32_t most_px);

/// Consecutive frames in which half of a map's edge must meet the target before the map shrinks. A second at 60 Hz is
/// longer than a short look aside.
inline constexpr std::uint32_t kSpareFrames = 60;

/// Frames with moving maps after which fewer cascades are considered: a second of steady movement, as for sizes. The
/// choice costs one fit per candidate number, and a change draws all maps.
inline constexpr std::uint32_t kMovesToCount = kSpareFrames;

/// Fit of a sun with one number of cascades.
struct CascadeTrial {
    std::uint32_t count = 0;
    double predicted_px = 0.0;
    std::uint64_t texels = 0;  // sum over all its maps
};

/// Chooses a sun's number of cascades from trials with rising counts. `previous`: the present number; 0: none.
///
/// It is the fewest that meet the target with at most the texels of the last trial. The present number stays, unless
/// fewer do, while it meets the target with less than twice those texels.
///
/// If no trial does, all have maps of the largest size, and the least product of count and error is chosen. The error
/// is taken for equal texels in total, which is larger by the root of the count. So twice as many maps must halve the
/// predicted error beyond the gain of their additional texels. Reason: the bound is that of the worst place, near the
/// camera. Elsewhere texels of cascades are no smaller, and thinner casters are lost. Measured with equal texels
/// (docs/results/cost.md): courtyard and Sponza, where four maps divide the bound by 1.5 to 2.5, are best with one. A
/// valley of kilometres, where they divide it by 6 to 50, is best with two or four. The present number stays while the
/// least product is at least 1 / sqrt(2) of its own. Rounding two sides to steps changes a product by as much.
std::uint32_t choose_cascades(std::span<const CascadeTrial> trials, std::uint32_t previous, double target_px);

/// Returns true if maps with the error `predicted_px` meet the target `target_px`.
bool meets_target(double predicted_px, double target_px);

/// Computes the allowed error of an edge, pixels, under a light that meets its target. `cosine`: n·l of the receiver.
/// Up to 60 degrees it is `target_px` + 1; beyond, `target_px` grows with the texel's stretch (slope_factor).
double allowed_error_px(double target_px, double cosine);

}  // namespace gnomon::shadow
