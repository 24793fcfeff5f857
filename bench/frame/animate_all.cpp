#include "bench/frame/animate_all.h"

#include <algorithm>

#include "gnomon/components.h"
#include "gnomon/light.h"
#include "systems/extract/light_facts.h"

namespace gnomon::bench {
namespace {

// A stroll (1.4 m/s at most) and a sun that hurries (a degree a second at most): every frame differs from the last.
constexpr double kWalk_m = 0.9, kWalkPeriod_s = 4.0;
constexpr double kTurn_rad = 0.03, kTurnPeriod_s = 10.0;

}  // namespace

std::vector<game::MovingEntity> everything_moving(const game::SpawnedScene& spawned, const ecs::Registry& world) {
    std::vector<game::MovingEntity> moving = spawned.moving;
    const auto add = [&](ecs::Entity entity, const char* kind, const glm::dvec3& axis, double amplitude,
                         double period_s) {
        const Transform* rest = world.get<Transform>(entity);
        const bool moves =
            std::any_of(moving.begin(), moving.end(), [&](const game::MovingEntity& m) { return m.entity == entity; });
        if (rest && !moves)
            moving.push_back(
                {entity, *rest, {.kind = kind, .axis = axis, .amplitude = amplitude, .period_s = period_s}});
    };
    for (const game::NamedEntity& light : spawned.lights)
        if (const Light* l = world.get<Light>(light.entity); l && light_facts(l->kind).parallel)
            add(light.entity, "swing", {0.0, 1.0, 0.0}, kTurn_rad, kTurnPeriod_s);
    for (const game::NamedEntity& camera : spawned.cameras)
        add(camera.entity, "slide", {1.0, 0.0, 0.0}, kWalk_m, kWalkPeriod_s);
    for (const ecs::Entity node : spawned.nodes)
        if (const Name* name = world.get<Name>(node); name && name->text == "player")
            add(node, "slide", {0.0, 0.0, 1.0}, kWalk_m, kWalkPeriod_s);
    return moving;
}

}  // namespace gnomon::bench
