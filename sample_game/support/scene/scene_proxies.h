#pragma once
#include "gnomon/assets.h"
#include "gnomon/registry.h"
#include "sample_game/support/scene/spawn_scene.h"

namespace gnomon::game {

/// Makes proxies of the library's meshes if any of the scene's lights draws them. Call it before a Frame has the
/// library.
void provide_proxies(const SpawnedScene& scene, const ecs::Registry& registry, assets::MeshLibrary& library);

}  // namespace gnomon::game
