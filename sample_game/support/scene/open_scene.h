#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "gnomon/assets.h"
#include "gnomon/result.h"
#include "sample_game/support/scene/spawn_scene.h"

namespace gnomon::game {

/// Name of the built-in scene of kilometres, in place of a file's. It cannot be a glTF file, which has a suffix.
inline constexpr const char* kValleyScene = "valley";
/// Name of the built-in scene of many triangles.
inline constexpr const char* kSpheresScene = "spheres";
/// Name of the built-in scene of coloured glass.
inline constexpr const char* kPanesScene = "panes";

/// Loads `file`, the valley, the spheres or the panes by their names, or the courtyard without a name. Built-in scenes
/// are made in memory and take the same loader. Errors: as assets::load_gltf.
Result<assets::SceneData> load_scene(const std::optional<std::filesystem::path>& file);

/// Loads the courtyard with the game's additions.
Result<assets::SceneData> load_game_scene();

/// Finds a camera by name, else by index. Error: rule "camera.unknown".
Result<std::size_t> find_camera(const SpawnedScene& scene, const std::string& name_or_index,
                                const char* flag = "--camera");

}  // namespace gnomon::game
