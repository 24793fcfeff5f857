#pragma once
#include "engine/gl/commands.h"
#include "systems/extract/snapshot.h"

/// Screen-space bounds of a light's range.
namespace gnomon::shadow {

/// Pixels around what is computed that a rasteriser's rounding may reach, and neighbours that antialiased edges read.
inline constexpr double kRasterMargin_px = 2.0;

/// Returns the pixels that a light can reach in a camera view: the whole viewport for a sun or a point light without a
/// range. Otherwise the rectangle around a ball that contains the range, or its part in a spot's cone, or around a cone
/// without an end. Empty if the camera does not see it. Conservative.
gl::Rect screen_rectangle(const LightItem& light, const ConsumerItem& consumer);

/// Returns a lower bound on the reversed depths, in [0,1], of all surfaces up to a distance along the view.
float depth_bound(double farthest_m, const ConsumerItem& camera);

/// Returns a lower bound on the reversed depths, in [0,1], of all surfaces within the light's range. 0: no bound.
/// Conservative.
float farthest_depth(const LightItem& light, const ConsumerItem& consumer);

}  // namespace gnomon::shadow
