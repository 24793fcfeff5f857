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
/// Name of the built-in scene of a hundred thousand instances and three hundred lamps.
inline constexpr const char* kCityScene = "city";
/// What --scene takes, for help texts.
inline constexpr const char* kSceneHelp =
    "FILE: glTF or GLB, valley, spheres, panes or city (default: the built-in courtyard)";

/// Loads `file`, a built-in scene by its name, or the courtyard without a name. Built-in scenes are made in memory and
/// take the same loader. Errors: as assets::load_gltf.
Result<assets::SceneData> load_scene(const std::optional<std::filesystem::path>& file);

/// Loads the courtyard with the game's additions.
Result<assets::SceneData> load_game_scene();

/// Finds a camera by name, else by index. Error: rule "camera.unknown".
Result<std::size_t> find_camera(const SpawnedScene& scene, const std::string& name_or_index,
                                const char* flag = "--camera");

}  // namespace gnomon::game
