#include "sample_game/support/scene/open_scene.h"

#include <algorithm>

#include "gnomon/assets.h"
#include "sample_game/support/built_in_scenes/city/city.h"
#include "sample_game/support/built_in_scenes/courtyard/courtyard.h"
#include "sample_game/support/built_in_scenes/panes.h"
#include "sample_game/support/built_in_scenes/spheres.h"
#include "sample_game/support/built_in_scenes/valley/valley.h"
#include "sample_game/support/settings/parse_number.h"

namespace gnomon::game {

Result<assets::SceneData> load_scene(const std::optional<std::filesystem::path>& file) {
    if (file == kValleyScene) return assets::load_gltf_memory(make_valley().glb, {}, "built-in valley");
    if (file == kSpheresScene) return assets::load_gltf_memory(make_spheres().glb, {}, "built-in spheres");
    if (file == kPanesScene) return assets::load_gltf_memory(make_panes(), {}, "built-in panes");
    if (file == kCityScene) return assets::load_gltf_memory(make_city().glb, {}, "built-in city");
    if (file) return assets::load_gltf(*file);
    return assets::load_gltf_memory(make_courtyard().glb, {}, "built-in courtyard");
}

Result<assets::SceneData> load_game_scene() {
    return assets::load_gltf_memory(make_courtyard({.game = true}).glb, {}, "built-in courtyard");
}

Result<std::size_t> find_camera(const SpawnedScene& scene, const std::string& name_or_index, const char* flag) {
    const auto named = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                    [&](const NamedEntity& camera) { return camera.name == name_or_index; });
    if (named != scene.cameras.end()) return static_cast<std::size_t>(named - scene.cameras.begin());
    const auto index = read_count(name_or_index);
    if (index && *index < scene.cameras.size()) return static_cast<std::size_t>(*index);

    constexpr std::size_t kShown = 8;
    std::string known;
    for (std::size_t i = 0; i < std::min(scene.cameras.size(), kShown); ++i)
        known += (i == 0 ? "" : ", ") + scene.cameras[i].name;
    if (scene.cameras.size() > kShown) known += ", ...";
    return Error{
        .message = on_one_line(std::string(flag) + ": no camera '" + name_or_index + "'; the scene has " + known),
        .rule = "camera.unknown"};
}

}  // namespace gnomon::game
