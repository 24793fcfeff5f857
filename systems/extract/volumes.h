#pragma once
#include "engine/math/frustum.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// Width over height of the consumer's picture.
double aspect(const ConsumerItem& consumer);

/// What the consumer sees, world space; and only from another near plane on, or up to another far plane as well.
math::Frustum consumer_frustum(const ConsumerItem& consumer);
math::Frustum consumer_frustum(const ConsumerItem& consumer, double near_m);
math::Frustum consumer_frustum(const ConsumerItem& consumer, double near_m, double far_m);

/// What it would see, stood it in the world's origin: free of the rounding that its place costs.
math::Frustum consumer_frustum_at_origin(const ConsumerItem& consumer);

/// The pyramid around a spot's cone, cut at far_m (infinite: uncut). tan_half > 0.
math::Frustum pyramid(const glm::dvec3& apex_ws_m, const glm::dmat3& rotation_ws, double tan_half, double far_m);

/// Metres a pixel covers at distance 1 (perspective) or anywhere (orthographic).
double pixel_footprint(const ConsumerItem& consumer);

}  // namespace gnomon
