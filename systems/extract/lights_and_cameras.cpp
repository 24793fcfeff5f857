#include "systems/extract/lights_and_cameras.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/put.h"
#include "gnomon/components.h"
#include "systems/extract/camera_view.h"
#include "systems/extract/light_facts.h"
#include "systems/extract/names.h"
#include "systems/extract/placed_light.h"
#include "systems/extract/unique_names.h"
#include "systems/extract/usable.h"

namespace gnomon {
namespace {

using Effect = LightsAndCameras::Effect;

/// Writes all but the name. Sets shape_version to `version` if that differs. Returns true if anything does.
bool put_light(const ecs::Registry& registry, const Light& light, const WorldTransform& world, std::uint64_t version,
               LightItem& item) {
    const LightShadow* shadow = registry.get<LightShadow>(item.entity);
    const ShadowTuning* tuning = shadow ? registry.get<ShadowTuning>(item.entity) : nullptr;
    const LightItem now = placed(light, world);
    bool shape = put(item.kind, now.kind);
    shape |= put(item.position_ws_m, now.position_ws_m);
    shape |= put(item.rotation_ws, now.rotation_ws);
    shape |= put(item.range_m, now.range_m);
    shape |= put(item.inner_cone_rad, now.inner_cone_rad);
    shape |= put(item.outer_cone_rad, now.outer_cone_rad);
    shape |= put(item.source_radius_m, now.source_radius_m);
    shape |= put(item.sun_radius_rad, now.sun_radius_rad);
    shape |= put(item.width_m, now.width_m);
    shape |= put(item.height_m, now.height_m);
    shape |= put(item.has_shadow, shadow != nullptr);
    shape |= put(item.shadow, shadow ? *shadow : LightShadow{});
    shape |= put(item.tuning, tuning ? *tuning : ShadowTuning{});
    bool any = put(item.colour, light.colour);
    any |= put(item.intensity, light.intensity);
    if (shape) item.shape_version = version;
    return shape || any;
}

/// Writes all but name and viewport. Returns true if anything differs. An orthographic camera's range is limited later.
bool put_camera(const Camera& camera, const WorldTransform& world, ConsumerItem& item) {
    ConsumerItem now;
    now.projection = camera.projection;
    now.viewport_px = item.viewport_px;
    place_camera(camera, world, now);
    fit_frame(camera, now);
    bool any = put(item.position_ws_m, now.position_ws_m);
    any |= put(item.rotation_ws, now.rotation_ws);
    any |= put(item.projection, now.projection);
    any |= put(item.fov_y_rad, now.fov_y_rad);
    any |= put(item.half_height_m, now.half_height_m);
    any |= put(item.near_m, now.near_m);
    any |= put(item.far_m, now.far_m);
    return any;
}

/// Finds an entity's item. Both lists are sorted by entity index.
template <class Item>
Item* find(std::vector<Item>& items, ecs::Entity entity) {
    const auto at = std::lower_bound(items.begin(), items.end(), entity.index,
                                     [](const Item& item, std::uint32_t index) { return item.entity.index < index; });
    return at != items.end() && at->entity == entity ? &*at : nullptr;
}

template <class Item>
void sort_by_entity(std::vector<Item>& items) {
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.entity.index < b.entity.index; });
}

Effect touch_light(const ecs::Registry& registry, ecs::Entity entity, const WorldTransform* world,
                   SceneSnapshot& snapshot) {
    LightItem* item = find(snapshot.lights, entity);
    const Light* light = registry.get<Light>(entity);
    const bool wanted = light && world && usable(*light);
    if (wanted != (item != nullptr)) return Effect::listing;
    return item && put_light(registry, *light, *world, snapshot.version, *item) ? Effect::changed : Effect::none;
}

Effect touch_camera(const ecs::Registry& registry, ecs::Entity entity, const WorldTransform* world,
                    SceneSnapshot& snapshot) {
    ConsumerItem* item = find(snapshot.consumers, entity);
    const Camera* camera = registry.get<Camera>(entity);
    const bool wanted = camera && camera->active && world && usable(*camera);
    if (wanted != (item != nullptr)) return Effect::listing;
    return item && put_camera(*camera, *world, *item) ? Effect::changed : Effect::none;
}

/// Restores the versions of lights that equal those of the snapshot before list().
void keep_versions(std::vector<LightItem>& before, const ecs::Registry& registry, std::uint64_t version,
                   std::vector<LightItem>& lights) {
    for (LightItem& light : lights) {
        const Light& component = *registry.get<Light>(light.entity);
        const WorldTransform& world = *registry.get<WorldTransform>(light.entity);
        LightItem* was = find(before, light.entity);
        if (!was) {
            put_light(registry, component, world, version, light);
            light.shape_version = version;
            continue;
        }
        std::swap(was->name, light.name);
        put_light(registry, component, world, version, *was);
        light = std::move(*was);
    }
}

}  // namespace

void LightsAndCameras::list(const ecs::Registry& registry, glm::uvec2 viewport_px, SceneSnapshot& snapshot) {
    std::vector<LightItem> before = std::exchange(snapshot.lights, {});
    snapshot.consumers.clear();
    unusable_.clear();
    registry.each<Light, WorldTransform>([&](ecs::Entity e, const Light& light, const WorldTransform&) {
        if (usable(light))
            snapshot.lights.emplace_back().entity = e;
        else
            unusable_.push_back({e, name_of(registry, e), DropReason::absurd_light});
    });
    registry.each<Camera, WorldTransform>([&](ecs::Entity e, const Camera& camera, const WorldTransform& world) {
        if (!camera.active) return;
        if (!usable(camera)) return unusable_.push_back({e, name_of(registry, e), DropReason::absurd_camera});
        ConsumerItem& item = snapshot.consumers.emplace_back();
        item.entity = e;
        item.name = name_of(registry, e);
        item.viewport_px = viewport_px;
        put_camera(camera, world, item);
    });
    sort_by_entity(snapshot.lights);
    sort_by_entity(snapshot.consumers);
    for (LightItem& light : snapshot.lights) light.name = name_of(registry, light.entity);
    make_names_unique(snapshot.lights);
    keep_versions(before, registry, snapshot.version, snapshot.lights);
}

Effect LightsAndCameras::touch(const ecs::Registry& registry, ecs::Entity entity, SceneSnapshot& snapshot) const {
    const WorldTransform* world = registry.get<WorldTransform>(entity);
    const Effect light = touch_light(registry, entity, world, snapshot);
    const Effect camera = touch_camera(registry, entity, world, snapshot);
    return std::max(light, camera);
}

Effect LightsAndCameras::rename(const ecs::Registry& registry, std::span<const ecs::Entity> named,
                                SceneSnapshot& snapshot) const {
    bool lights = false;
    Effect effect = Effect::none;
    for (const ecs::Entity e : named) {
        lights = lights || find(snapshot.lights, e) != nullptr;
        ConsumerItem* consumer = find(snapshot.consumers, e);
        if (consumer && put(consumer->name, name_of(registry, e))) effect = Effect::changed;
        const auto is_it = [&](const DroppedEntity& dropped) { return dropped.entity == e; };
        if (std::any_of(snapshot.dropped.begin(), snapshot.dropped.end(), is_it)) return Effect::listing;
    }
    if (!lights) return effect;
    std::vector<std::string> before(snapshot.lights.size());
    for (std::size_t i = 0; i < before.size(); ++i)
        before[i] = std::exchange(snapshot.lights[i].name, name_of(registry, snapshot.lights[i].entity));
    make_names_unique(snapshot.lights);
    for (std::size_t i = 0; i < before.size(); ++i)
        if (before[i] != snapshot.lights[i].name) effect = Effect::changed;
    return effect;
}

}  // namespace gnomon
