#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/registry.h"
#include "sample_game/game/session.h"
#include "sample_game/support/scene/spawn_scene.h"

namespace gnomon::game {

/// The loaded scene as entities.
struct GameWorld {
    ecs::Registry registry;
    assets::MeshLibrary library;
    SpawnedScene scene;
    std::size_t camera = 0;                 // index into scene.cameras: the active one
    std::optional<std::size_t> fit_camera;  // index of the camera that shadows are fitted to; empty: the active one
    ecs::Entity mist = ecs::kNull;          // its FogVolume; kNull: none
    std::unique_ptr<GameSession> game;      // null: the scene is only looked at
    std::vector<std::string> warnings;      // warnings of the loader, one line each
};

}  // namespace gnomon::game
