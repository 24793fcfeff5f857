#pragma once
#include "engine/gl/commands.h"
#include "systems/extract/snapshot.h"

/// What of a picture a light can reach.
namespace gnomon::shadow {

/// Pixels a light can reach in the consumer's picture: the whole viewport for a sun or an unlimited light, the bounding
/// rectangle of a ball around its range, a spot's around its cone, otherwise; empty if that is behind the camera or
/// beyond its far plane. Conservative.
gl::Rect screen_rectangle(const LightItem& light, const ConsumerItem& consumer);

/// Depth of the picture (reversed, in [0,1]) that all surfaces within the light's reach exceed; 0: any surface may be.
/// Conservative.
float farthest_depth(const LightItem& light, const ConsumerItem& consumer);

}  // namespace gnomon::shadow
