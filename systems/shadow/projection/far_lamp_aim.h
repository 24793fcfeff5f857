#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/projection/light_frusta.h"

/// Aimed view of a far lamp. Its visible receivers fill little of a cube's face or a spot's cone, so that texels over
/// the whole would be coarse. A crop along the light's own axes could lie so far off-centre that floats lose its
/// position. Therefore one view looks at a ball around these receivers, and is cropped like a spot's view.
namespace gnomon::shadow {

/// Index of the aimed view in the fit history, beside a cone's faces and its single view.
inline constexpr std::uint32_t kAimedView = 6;

/// Computes the aim of this frame. Not `used`: the lamp has the maps of its kind. `previous`: aim of the last frame. It
/// stays, bit for bit, while it contains all visible receivers and is at most 32 times too large. Aiming ends at twice
/// the angle at which it begins.
FarLampAim next_far_lamp_aim(const SceneSnapshot& scene, const LightItem& light, const FarLampAim& previous);

/// Returns the light frustum around the ball; layer 0.
LightFrustum aimed_frustum(const LightItem& light, const FarLampAim& aim);

}  // namespace gnomon::shadow
