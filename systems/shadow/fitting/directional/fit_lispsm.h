#pragma once
#include "systems/shadow/fitting/directional/cascade_fit.h"

/// Light-space perspective shadow maps (Wimmer, Scherzer, Purgathofer 2004) for one cascade of a sun: texels grow with
/// the distance from the camera, across the light. Depth along the light is left alone: all of a ray has one w, and
/// what is nearer to the light than the map's range casts as it does without a warp.
namespace gnomon::shadow {

/// The tight rectangle around the cascade's points after a warp, its anchor below the end nearest to the camera.
/// `strength` 0 to 1: the w of the far end over that of the near end is at most r^(strength / 2), r being the depths'
/// ratio of section 4.2 there (its n_opt, written as that ratio). As far as that, the warp makes the mean texel on the
/// screen smallest, the mean taken evenly over the depths' logarithm, and the worst one no larger. It fades to none as
/// the view's direction nears the light's, as what it gains fades, and where all receivers are equally deep. For a view
/// without perspective there is none. `tight`: fit_tight's box for these points.
ShadowView warped_view(const CascadeInput& input, double strength, const OrthographicBox& tight);

/// From the view's axes, warp, centre, half extents and depth range (near_m < 0 = far_m). w > 0 all over the map.
void set_warped_matrices(ShadowView& view);

}  // namespace gnomon::shadow
