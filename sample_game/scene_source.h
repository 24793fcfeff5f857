#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "engine/assets/scene_data.h"
#include "engine/core/result.h"
#include "sample_game/spawn.h"

namespace gnomon::game {

/// `file`, or the built-in courtyard if there is none: it is made in memory and takes the same loader.
/// Errors: those of assets::load_gltf.
Result<assets::SceneData> load_scene(const std::optional<std::filesystem::path>& file);

/// The courtyard with what the game adds to it.
Result<assets::SceneData> load_game_scene();

/// The camera called `name_or_index`: by name, else by index. Error: rule "camera.unknown".
Result<std::size_t> find_camera(const SpawnedScene& scene, const std::string& name_or_index,
                                const char* flag = "--camera");

}  // namespace gnomon::game
