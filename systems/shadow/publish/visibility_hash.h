#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/drawn_views.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::shadow {

/// Sets LightingLight::lookup_signature of one camera's lights, as published. It hashes the record without the light's
/// colour and strength, the program and the textures. It also hashes the pixels that the light can reach, and the
/// content of its maps. 0:
/// - the light is not looked up;
/// - caching is off (ShadowTuning::Reuse::economy, keep_visibility);
/// - its maps are stale, or rays replace them;
/// - the scene does not count its changes.
void sign_lookups(const SceneSnapshot& scene, const DrawnViews& drawn, LightingInputs& inputs);

}  // namespace gnomon::shadow
