#pragma once
#include <span>

#include "systems/shadow/projection/orthographic_view.h"
#include "systems/shadow/request/light_kinds.h"

/// The three ways to fit one cascade of a sun: ShadowFit.
namespace gnomon::shadow {

/// Sizes, kept by hysteresis, that a fit may change in this frame.
enum class Stepping {
    as_needed,
    larger,    // only sizes too small for what is seen
    together,  // a size changes in this frame anyway: sizes that soon would change do so too
};

struct CascadeInput {
    const FitInput& light;
    const glm::dmat3& basis;                // axes of the light: right, up, toward it
    std::uint32_t index;                    // index of the cascade, also in the fit history
    double from_m, to_m;                    // slice along the first camera's view
    bool of_all;                            // the cascade serves several cameras: points_ws reaches beyond the slice
    std::span<const glm::dvec3> points_ws;  // corners of the visible parts of receivers in it; not empty
    Stepping stepping = Stepping::as_needed;
};

/// Fit of one cascade. Returns false if nothing finite lies in the slice. Pure function; the fit history is an input
/// and an output.
using CascadeFit = bool (*)(const CascadeInput& input, OrthographicBox& box);

/// Fits the smallest rectangle around the points in the light's plane, at any angle. Depth reaches from the nearest to
/// the farthest point.
bool fit_tight(const CascadeInput& input, OrthographicBox& box);

/// Fits a cube around the bounding sphere of the slice, snapped to a grid of texels. It is constant while lens and
/// slice are.
bool fit_stable(const CascadeInput& input, OrthographicBox& box);

/// Fits a rectangle around the points along the light's own axes, snapped to its texels. Sides and depth are steps of
/// 2^(1/4). The last frame's rectangle stays while it contains the points and is not much too large.
bool fit_quantised(const CascadeInput& input, OrthographicBox& box);

CascadeFit cascade_fit(ShadowFit mode);

/// Least extent of a map, as a share of the largest extent. It keeps divisors above 0 where all receivers lie in one
/// plane.
inline constexpr double kLeastExtent = 1.0 / (1 << 20);
/// Slack at both ends of the depth range, as a share of the largest extent. It keeps receivers clear of the clamp even
/// where all lie at one depth. A lookup rounds by 2^-14 of that extent at most.
inline constexpr double kDepthSlack = 1.0 / (1 << 10);

/// Returns a point of a world-fixed grid near `centre_ws`. It is the same for all fits of about this size, while
/// cameras move.
glm::dvec3 lattice_anchor(const glm::dvec3& centre_ws, double extent_m);

/// Returns the edge of a map that contains `extent_m` and the border that a filter needs, metres.
double with_border(double extent_m, const FitInput& input);

/// Places the map with this centre (world, metres) and these extents: fills all of `box` except its axes. Depth gets
/// slack at both ends. Before the receivers it also gets room for the greatest lift by the bias. A receiver lifted to
/// the near plane would be lit below a caster that is flattened onto it.
void place(const CascadeInput& input, const glm::dvec3& centre_ws, const glm::dvec2& extent_m, double depth_m,
           OrthographicBox& box);

}  // namespace gnomon::shadow
