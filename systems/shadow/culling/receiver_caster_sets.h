#pragma once
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/light_accounts.h"
#include "systems/shadow/frame/receiver_caster_sets.h"
#include "systems/shadow/frame/shadow_request.h"

namespace gnomon::shadow {

/// What the search for receivers and casters reads, beside the scene.
struct SetInputs {
    std::span<const ShadowRequest> requests;  // one per light
    std::span<const glm::dvec3> lamps_ws_m;   // one per light (lamp_offsets.h); empty: where the lights are
};

/// Stage 3: finds, for each light that is not skipped, the receivers that a camera sees and the light reaches (PSR),
/// with the corner points of what is seen of them, and the casters in the volume swept from those points toward the
/// light (PSC), seen or not. All lists are by index. A light without one or the other is skipped.
/// Conservative: bounds stand for meshes, but for the depth from which a camera sees any (nearest_receiver.h).
/// Searches scene.tree where the scene has one (systems/extract/scene_tree.h); the result is the same without.
void select_sets(const SceneSnapshot& scene, const SetInputs& inputs, SetScratch& scratch, ReceiverCasterSets& sets,
                 const LightAccounts& accounts);

/// Returns the sets of one light, appended to the arrays of `out`, which must hold the cameras' frusta.
LightSets select_light_sets(const SceneSnapshot& scene, std::uint32_t light, const ShadowRequest& request,
                            const glm::dvec3& lamp_ws_m, SetScratch& scratch, ReceiverCasterSets& out);

/// Whether the light reaches any instance that the consumer may see, shadow or not: else it adds nothing to the
/// picture. Conservative as the sets are.
bool reaches_anything_seen(const SceneSnapshot& scene, const LightItem& light, const ConsumerItem& consumer);

/// Returns the planes that hold all that is seen; none where several cameras look on.
std::span<const math::Plane> seen_by_the_only_consumer(std::span<const math::Frustum> camera_frusta);

}  // namespace gnomon::shadow
