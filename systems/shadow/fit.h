#pragma once
#include <glm/vec3.hpp>
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/types.h"

namespace gnomon::shadow {

/// Stage 4: the views of every light that is not skipped, each with its own casters and predicted edge error.
/// Sets sets[i].skip = fit_degenerate where no finite volume exists. Pure but for `frame`; `held` is the next_history of
/// the frame before (empty: none), frame.next_history that of this one.
void fit_views(const SceneSnapshot& scene, const History& held, ShadowFrame& frame);

/// How far a shadow edge may be off in this view's map, in pixels of `consumer`, over the given receiver points:
/// 0.71 texel diagonal plus half a pixel (a one-tap edge error is at most 0.71 m + 0.5 px, m the
/// longest extent of a texel on screen), for receivers that face light and camera. 0 without points in front of the
/// camera.
double predict_error_px(const ShadowView& view, const ConsumerItem& consumer, std::span<const glm::dvec3> points_ws);

}  // namespace gnomon::shadow
