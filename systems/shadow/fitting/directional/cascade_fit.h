#pragma once
#include <span>

#include "systems/shadow/projection/orthographic_view.h"
#include "systems/shadow/request/light_kinds.h"

/// The three ways to fit one cascade of a sun: ShadowFit.
namespace gnomon::shadow {

/// Which held sizes a fit may change.
enum class Stepping {
    as_needed,
    larger,    // those alone that no longer hold what is seen
    together,  // some step in this frame: what soon would may do so with them
};

struct CascadeInput {
    const FitInput& light;
    const glm::dmat3& basis;  // of the light: right, up, toward it
    std::uint32_t index;      // of the cascade, also in the history
    double from_m, to_m;      // the slice, along the first consumer's view
    bool of_all;              // it holds what several consumers see: points_ws then knows more than the slice
    std::span<const glm::dvec3> points_ws;  // what is seen of receivers in it; not empty
    Stepping stepping = Stepping::as_needed;
};

/// False if nothing finite lies there. Pure, history included.
using CascadeFit = bool (*)(const CascadeInput& input, OrthographicBox& box);

/// The smallest rectangle around the points, as the light sees them, at any angle; depth from the nearest to the
/// farthest.
bool fit_tight(const CascadeInput& input, OrthographicBox& box);

/// A cube around the smallest sphere of the slice, on a grid of texels: constant while the lens and the slice are.
bool fit_stable(const CascadeInput& input, OrthographicBox& box);

/// A rectangle around the points along the light's own axes, its sides and depth in steps of 2^(1/4), on its own
/// texels; the last frame's stays while it holds the points and is not much too large.
bool fit_quantised(const CascadeInput& input, OrthographicBox& box);

CascadeFit cascade_fit(ShadowFit mode);

/// A flat set of receivers gets at least this share of the largest extent, so that nothing divides by zero.
inline constexpr double kLeastExtent = 1.0 / (1 << 20);
/// Receivers at the ends of the depth range stay clear of the clamp by this share of the largest extent, so that
/// rounding takes none out of the range even where all lie at one depth: a lookup rounds by 2^-14 of it at most.
inline constexpr double kDepthSlack = 1.0 / (1 << 10);

/// A lattice point near `centre_ws`, the same for all fits of about this size: fixed to the world while cameras move.
glm::dvec3 lattice_anchor(const glm::dvec3& centre_ws, double extent_m);

/// Extent of a map that holds `extent_m` and the border that a filter needs.
double with_border(double extent_m, const FitInput& input);

/// Where the map lies that has this centre (world, in metres) and these extents; fills all of `box` but its axes. Depth
/// gets slack at both ends, and before the receivers as much room as the bias may lift them: one that reached the near
/// plane would be lit below a caster that is flattened onto it.
void place(const CascadeInput& input, const glm::dvec3& centre_ws, const glm::dvec2& extent_m, double depth_m,
           OrthographicBox& box);

}  // namespace gnomon::shadow
