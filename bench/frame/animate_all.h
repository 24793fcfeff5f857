#pragma once
#include <vector>

#include "gnomon/registry.h"
#include "sample_game/support/scene/node_motion.h"
#include "sample_game/support/scene/spawn_scene.h"

namespace gnomon::bench {

/// Returns the motions of the scene itself, and all that a game would add, for game::apply_motion(). Suns without a
/// motion turn to and fro; cameras and the entity named "player" walk to and fro.
std::vector<game::MovingEntity> everything_moving(const game::SpawnedScene& spawned, const ecs::Registry& world);

}  // namespace gnomon::bench
