#pragma once
#include "sample_game/game/rules.h"

namespace gnomon::game {

/// Returns the next input of the scripted walk of --demo: from the start of the courtyard, behind its screens, to the
/// gate. It depends on the state alone, so that the same level gives the same walk.
GameInput demo_input(const GameState& state);

}  // namespace gnomon::game
