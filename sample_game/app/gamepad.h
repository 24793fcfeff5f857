#pragma once
#include <span>

#include "gnomon/window.h"
#include "sample_game/game/rules.h"

namespace gnomon::game {

/// Translates gamepads to GameInput. Several pads act as one. Pure function. Controls:
/// - left stick walks, right stick looks, right trigger or a bumper runs;
/// - left and right of the cross move the sun, start pauses, back starts again.
///
/// `before`: the same slots one poll ago. A button counts as pressed if its pad was present then and the button was up,
/// so that plugging in and out presses nothing. `dt_s`: duration of the look. Sticks near their middle (kDeadZone),
/// axes that are no number and absent pads have no effect.
GameInput gamepad_input(std::span<const Gamepad> before, std::span<const Gamepad> now, double dt_s);

/// A worn stick rests up to here; beyond, its way counts from 0 again. XInput's own zones are 0.24 and 0.27.
inline constexpr double kDeadZone = 0.25;
inline constexpr double kLook_rad_per_s = 2.5;  // the stick at its end: half a turn in 1.3 s

/// Adds two inputs: axes to at most 1, turns without limit; a switch counts if either has it.
GameInput together(const GameInput& a, const GameInput& b);

}  // namespace gnomon::game
