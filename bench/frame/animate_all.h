#pragma once
#include <vector>

#include "engine/ecs/registry.h"
#include "sample_game/support/scene/node_motion.h"
#include "sample_game/support/scene/spawn_scene.h"

namespace gnomon::bench {

/// What the scene itself moves, and to it all that a game would: suns that do not move turn to and fro, cameras and
/// the entity named "player" walk to and fro. For game::apply_motion.
std::vector<game::MovingEntity> everything_moving(const game::SpawnedScene& spawned, const ecs::Registry& world);

}  // namespace gnomon::bench
