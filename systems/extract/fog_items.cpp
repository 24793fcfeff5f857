#include "systems/extract/fog_items.h"

#include <cstdint>
#include <glm/mat3x3.hpp>

#include "engine/math/aabb.h"
#include "engine/math/finite.h"
#include "gnomon/components.h"
#include "systems/extract/drawable_basis.h"
#include "systems/extract/usable.h"

namespace gnomon {

bool is_fog(const ecs::Registry& registry, ecs::Entity entity) {
    const FogVolume* fog = registry.get<FogVolume>(entity);
    return fog && usable(*fog) && !registry.has<MeshRef>(entity);
}

bool put_fog(const ecs::Registry& registry, InstanceItem& item) {
    const WorldTransform* world = registry.get<WorldTransform>(item.entity);
    if (!world || !is_fog(registry, item.entity)) return false;
    const std::optional<glm::dmat3> basis = drawable_basis(world->basis);
    if (!basis) return false;
    const FogVolume& fog = *registry.get<FogVolume>(item.entity);
    item.mesh = kNoMesh;
    item.receives = fog.receives_shadow;
    item.receive_layers = fog.shadow_layers;
    item.basis = *basis;
    item.translation_ws_m = world->translation_ws_m;
    item.bounds_ws = math::transformed({-fog.half_extent_m, fog.half_extent_m}, *basis, world->translation_ws_m);
    return !math::is_empty(item.bounds_ws) && math::is_finite(item.bounds_ws);
}

std::optional<InstanceItem> fog_instance(const ecs::Registry& registry, ecs::Entity entity) {
    InstanceItem item;
    item.entity = entity;
    if (!put_fog(registry, item)) return std::nullopt;
    return item;
}

void list_fogs(const ecs::Registry& registry, SceneSnapshot& snapshot) {
    snapshot.air.fogs.clear();
    snapshot.air.any = false;
    for (std::uint32_t i = 0; i < snapshot.instances.size(); ++i) {
        const InstanceItem& item = snapshot.instances[i];
        if (!is_air(item)) continue;
        snapshot.air.any = true;
        const FogVolume& fog = *registry.get<FogVolume>(item.entity);
        if (fog.extinction_per_m > 0.0f)
            snapshot.air.fogs.push_back({i, fog.half_extent_m, fog.extinction_per_m, fog.albedo, fog.anisotropy});
    }
}

}  // namespace gnomon
