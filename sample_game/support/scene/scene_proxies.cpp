#include "sample_game/support/scene/scene_proxies.h"

#include <algorithm>

#include "gnomon/light.h"
#include "gnomon/shadow_tuning.h"

namespace gnomon::game {

void provide_proxies(const SpawnedScene& scene, const ecs::Registry& registry, assets::MeshLibrary& library) {
    const auto draws_proxies = [&](const NamedEntity& light) {
        const auto* tuning = registry.get<ShadowTuning>(light.entity);
        return registry.has<LightShadow>(light.entity) && tuning && tuning->maps.proxies;
    };
    if (std::any_of(scene.lights.begin(), scene.lights.end(), draws_proxies)) assets::add_proxies(library);
}

}  // namespace gnomon::game
