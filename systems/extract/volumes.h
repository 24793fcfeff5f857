#pragma once
#include <glm/vec2.hpp>

#include "engine/math/frustum.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// Computes width over height of the consumer's picture.
double aspect(const ConsumerItem& consumer);

/// Computes half the extent of its picture along its axes: tangents, or metres if it is orthographic.
glm::dvec2 half_extent(const ConsumerItem& consumer);

/// Computes the square of a distance over its view depth, for a corner of its picture in perspective: the largest.
double squared_corner_slant(const ConsumerItem& consumer);

/// Computes the consumer's view volume in world space, optionally with another near or far plane.
math::Frustum consumer_frustum(const ConsumerItem& consumer);
math::Frustum consumer_frustum(const ConsumerItem& consumer, double near_m);
math::Frustum consumer_frustum(const ConsumerItem& consumer, double near_m, double far_m);

/// Computes its view volume with the camera at the world's origin, free of rounding by a distant position.
math::Frustum consumer_frustum_at_origin(const ConsumerItem& consumer);

/// Computes the pyramid around a spot's cone, cut at far_m (infinite: uncut). tan_half > 0.
math::Frustum pyramid(const glm::dvec3& apex_ws_m, const glm::dmat3& rotation_ws, double tan_half, double far_m);

/// Computes a pixel's extent in metres, at distance 1 (perspective) or anywhere (orthographic).
double pixel_footprint(const ConsumerItem& consumer);

}  // namespace gnomon
