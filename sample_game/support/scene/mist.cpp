#include "sample_game/support/scene/mist.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include "gnomon/components.h"

namespace gnomon::game {
namespace {

/// Least half side of the mist, metres: a scene may be flat.
constexpr double kLeastHalf_m = 0.5;

ecs::Entity add_mist(const math::Aabb& bounds_ws, float extinction_per_m, ecs::Registry& registry) {
    const glm::dvec3 half_m = glm::max(0.5 * (bounds_ws.max - bounds_ws.min), glm::dvec3(kLeastHalf_m));
    const ecs::Entity mist = registry.create();
    registry.emplace<Transform>(mist, {.translation_m = 0.5 * (bounds_ws.min + bounds_ws.max)});
    registry.emplace<Name>(mist, {"mist"});
    registry.emplace<FogVolume>(mist, {.half_extent_m = half_m,
                                       .extinction_per_m = extinction_per_m,
                                       .albedo = glm::vec3(0.95f),
                                       .anisotropy = 0.4f});
    return mist;
}

}  // namespace

void set_mist(const math::Aabb& bounds_ws, float extinction_per_m, ecs::Entity& mist, ecs::Registry& registry) {
    if (math::is_empty(bounds_ws)) return;
    const bool wanted = extinction_per_m > 0.0f;
    if (mist == ecs::kNull) {
        if (wanted) mist = add_mist(bounds_ws, extinction_per_m, registry);
    } else if (wanted) {
        registry.patch<FogVolume>(mist, [&](FogVolume& fog) { fog.extinction_per_m = extinction_per_m; });
    } else {
        registry.destroy(std::exchange(mist, ecs::kNull));
    }
}

}  // namespace gnomon::game
