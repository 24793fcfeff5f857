#pragma once
#include <span>

#include "engine/core/jobs.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/light_accounts.h"
#include "systems/shadow/frame/receiver_caster_sets.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/frame/stage_storage.h"

namespace gnomon::shadow {

/// Inputs of the search for receivers and casters, beside the scene.
struct SetInputs {
    std::span<const ShadowRequest> requests;  // one per light
    std::span<const glm::dvec3> lamps_ws_m;   // one per light (lamp_offsets.h); empty: the lights' own positions
    Jobs* jobs = nullptr;                     // threads that share the lights; null: the calling one does all
};

/// Finds the potential receivers and casters of each light that is not skipped (stage 3), by index.
/// - Potential shadow receivers (PSR): in a camera's frustum and in the light's range, with the corners of their
///   clipped bounding boxes.
/// - Potential shadow casters (PSC): in the volume swept from those corners toward the light, visible or not.
/// - Lit areas: parts of the pictures that a light can light (lit_areas.h), also of lights without a shadow.
///
/// Skips lights without receivers or without casters. Conservative: bounding boxes represent meshes, except for the
/// depth of a camera's nearest receiver (nearest_receiver.h). Searches scene.tree where the scene has one
/// (systems/extract/scene_tree.h); the result is the same without, and on any number of threads.
void select_sets(const SceneSnapshot& scene, const SetInputs& inputs, StageStorage& storage, ReceiverCasterSets& sets,
                 const LightAccounts& accounts);

/// Finds the sets of one light and appends them to the arrays of `out`. Call after select_sets() for the same scene.
/// `scratch`: one of its storage's; `out` has its camera frusta.
LightSets select_light_sets(const SceneSnapshot& scene, std::uint32_t light, const ShadowRequest& request,
                            const glm::dvec3& lamp_ws_m, SetScratch& scratch, ReceiverCasterSets& out);

/// Returns the planes of the only camera's frustum; none if there are several cameras.
std::span<const math::Plane> seen_by_the_only_consumer(std::span<const math::Frustum> camera_frusta);

}  // namespace gnomon::shadow
