#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/types.h"

namespace gnomon::shadow {

/// Fills LightingLight::lookup_signature of one picture's lights, as they are published: a number that follows from the
/// record without the light's colour and strength, from the program, the textures, the pixels that the light can reach,
/// and from what its maps hold. 0 for a light that is not looked up, is to save nothing (ShadowTuning::Reuse), whose
/// maps show casters where they were while those go on or are left to rays as they change, and of scenes whose changes
/// nobody counts.
void sign_lookups(const SceneSnapshot& scene, const ShadowFrame& frame, LightingInputs& inputs);

}  // namespace gnomon::shadow
