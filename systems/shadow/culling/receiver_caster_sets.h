#pragma once
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/types.h"

namespace gnomon::shadow {

/// Stage 3: for each demand that is not skipped, the receivers that a consumer sees and the light reaches (PSR), with
/// the corner points of what is seen of them, and the casters in the volume swept from those points toward the light
/// (PSC), whether a camera sees those or not. Fills frame.sets, receiver_items, caster_items (both by index),
/// receiver_points_ws, beams, outlines, seen. Conservative: bounds stand for meshes, but for the depth from which a
/// consumer sees any (nearest_receiver.h). Searches scene.tree where the scene has one (systems/extract/scene_tree.h);
/// the result is the same without, the time is not.
void select_sets(const SceneSnapshot& scene, ShadowFrame& frame);

/// The same for one light whose fits made its maps another size: what of a cube's neighbours a face looks at, for the
/// filter's sake, is a share of its map. The sets of other kinds of light do not follow from their sizes, and stay.
void select_sets_again(const SceneSnapshot& scene, std::uint32_t d, ShadowFrame& frame);

/// Whether the light reaches any instance that the consumer may see, shadow or not: else it adds nothing to the
/// picture. Conservative as the sets are.
bool reaches_anything_seen(const SceneSnapshot& scene, const LightItem& light, const ConsumerItem& consumer);

/// Planes that hold all that is seen; none where several look on.
std::span<const math::Plane> seen_by_the_only_consumer(const ShadowFrame& frame);

}  // namespace gnomon::shadow
