#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/occluder.h"

namespace gnomon::shadow {

/// Largest number of occluders of a camera. The largest ones in the picture are taken.
inline constexpr std::size_t kMostOccluders = 32;

/// Diagonal of an occluder's bounds over its distance, from which on it is tested.
inline constexpr double kLeastOccluder_rad = 0.1;

/// Finds the camera's occluders: boxes inside of visible instances (MeshFacts::inner_boxes_ms), with the camera
/// outside of the instance, farther than its near plane is. None for an orthographic camera.
/// Cost: a walk of the scene's tree over what looks large.
void find_occluders(const SceneSnapshot& scene, const ConsumerItem& camera, std::vector<Occluder>& occluders);

/// Returns whether one of the occluders hides all points, and so their convex hull: what a convex body hides from a
/// point is convex. False without points.
bool are_hidden(std::span<const Occluder> occluders, std::span<const glm::dvec3> points_ws_m);

}  // namespace gnomon::shadow
