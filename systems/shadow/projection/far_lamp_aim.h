#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/projection/light_frusta.h"

/// Where a far lamp looks. What is seen of what it lights then fills so little of a cube's face, or of a spot's cone,
/// that texels laid over the whole would be coarse; a crop along the light's own axes would lie so far from its middle
/// that floats place it badly. One view toward a ball around all that is seen serves such a lamp, and is cropped as a
/// spot's view is.
namespace gnomon::shadow {

/// The aimed view's place among the held views: beside a cone's faces and its single view.
inline constexpr std::uint32_t kAimedView = 6;

/// One frame onward; not used: the lamp has the maps of its kind. `held`: what the last frame had; it stays, bit for
/// bit, while it holds all that is seen and is no more than 32 times too large. Once begun, it ends at twice the angle
/// at which it begins.
LampAim next_lamp_aim(const SceneSnapshot& scene, const LightItem& light, const LampAim& held);

/// Toward the ball, as wide as it is; layer 0.
LightOpening aimed_opening(const LightItem& light, const LampAim& aim);

}  // namespace gnomon::shadow
