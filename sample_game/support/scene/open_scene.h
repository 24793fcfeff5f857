#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "engine/assets/scene_data.h"
#include "engine/core/result.h"
#include "sample_game/support/scene/spawn_scene.h"

namespace gnomon::game {

/// What stands for a file's name and means the built-in scene of kilometres; no file without a suffix is a glTF.
inline constexpr const char* kValleyScene = "valley";
/// The same for the built-in scene of many triangles.
inline constexpr const char* kSpheresScene = "spheres";

/// `file`, or the built-in courtyard if there is none, or the valley or the spheres by their names: these are made in
/// memory and take the same loader.
/// Errors: those of assets::load_gltf.
Result<assets::SceneData> load_scene(const std::optional<std::filesystem::path>& file);

/// The courtyard with what the game adds to it.
Result<assets::SceneData> load_game_scene();

/// The camera called `name_or_index`: by name, else by index. Error: rule "camera.unknown".
Result<std::size_t> find_camera(const SpawnedScene& scene, const std::string& name_or_index,
                                const char* flag = "--camera");

}  // namespace gnomon::game
