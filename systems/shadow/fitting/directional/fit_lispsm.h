#pragma once
#include "systems/shadow/fitting/directional/cascade_fit.h"

/// Light-space perspective shadow maps (Wimmer, Scherzer, Purgathofer 2004) for one cascade of a sun: texels grow with
/// the distance from the camera, across the light. Depth along the light is unchanged: w is constant along a ray. So
/// what is nearer to the light than the map's range casts as without a warp.
namespace gnomon::shadow {

/// Fits the tight rectangle around the cascade's points after a warp, with its anchor below the end nearest to the
/// camera.
///
/// `strength`: 0 to 1. w at the far end over w at the near end is at most r^(strength / 2). r is the ratio of depths of
/// section 4.2 of the paper (its n_opt, written as that ratio). 0: no warp.
/// `tight`: fit_tight's box for these points.
///
/// Within that limit, the warp minimises the mean texel on the screen, taken evenly over the depths' logarithm. It
/// never makes the worst texel larger. It fades out, as its gain does, where the view's direction nears the light's,
/// and where all receivers are equally deep. A view without perspective has none.
ShadowView warped_view(const CascadeInput& input, double strength, const OrthographicBox& tight);

/// Sets the matrices from the view's axes, warp, centre, half extents and depth range (near_m < 0 = far_m). w must be
/// above 0 all over the map.
void set_warped_matrices(ShadowView& view);

}  // namespace gnomon::shadow
