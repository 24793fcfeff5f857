#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "engine/math/finite.h"
#include "systems/embed/light_orientation.h"
#include "systems/embed/scene_store.h"
#include "systems/extract/light_facts.h"
#include "systems/extract/unique_names.h"
#include "systems/extract/usable.h"

/// Lights of a SceneStore.
namespace gnomon::embed {
namespace {

ecs::Entity entity_of(LightId id) { return {id.index, id.version}; }

/// Writes a field. Returns true if its value changed, NaN included.
template <class T>
bool put_field(T& field, const T& value) {
    const bool same = field == value;
    field = value;
    return !same;
}

/// Returns whether the description is that of a light that can shine. Otherwise `fault` has the reason.
bool can_shine(const LightDesc& desc, DropReason& fault) {
    fault = DropReason::absurd_light;
    if (!gnomon::usable(desc.light)) return false;
    fault = DropReason::non_finite_transform;
    if (!math::is_finite(desc.position_m)) return false;
    fault = DropReason::zero_rotation;
    const LightFacts& facts = light_facts(desc.light.kind);
    return !facts.aimed() || orientation_of(desc).has_value();
}

/// Writes all but the name. Sets shape_version to `version` if that differs. Returns true if anything does.
bool put_light(const LightDesc& desc, const ShadowTuning& tuning, std::uint64_t version, LightItem& item) {
    const Light& light = desc.light;
    bool shape = put_field(item.kind, light.kind);
    shape |= put_field(item.position_ws_m, desc.position_m);
    shape |= put_field(item.rotation_ws, orientation_of(desc).value_or(glm::dmat3(1.0)));
    shape |= put_field(item.range_m, static_cast<double>(light.range_m));
    shape |= put_field(item.inner_cone_rad, static_cast<double>(light.inner_cone_rad));
    shape |=
        put_field(item.outer_cone_rad, std::min(static_cast<double>(light.outer_cone_rad), glm::half_pi<double>()));
    shape |= put_field(item.source_radius_m, light.source_radius_m);
    shape |= put_field(item.sun_radius_rad, light.sun_radius_rad);
    shape |= put_field(item.width_m, light.width_m);
    shape |= put_field(item.height_m, light.height_m);
    shape |= put_field(item.has_shadow, true);
    shape |= put_field(item.shadow, desc.shadow);
    shape |= put_field(item.tuning, tuning);
    bool any = put_field(item.colour, light.colour);
    any |= put_field(item.intensity, light.intensity);
    if (shape) item.shape_version = version;
    return shape || any;
}

}  // namespace

LightId SceneStore::add_light(const LightDesc& desc) {
    lights_anew_ = true;
    return lights_.add({desc, {}});
}

void SceneStore::set_light(LightId id, const LightDesc& desc) {
    StoredLight* light = lights_.find(id);
    if (!light) return;
    DropReason fault;
    if (light->desc.name != desc.name || can_shine(desc, fault) != (light->item != kNone)) lights_anew_ = true;
    light->desc = desc;
    light->set = lights_set_ = true;
}

void SceneStore::tune(LightId id, const ShadowTuning& tuning) {
    StoredLight* light = lights_.find(id);
    if (!light) return;
    light->tuning = tuning;
    light->set = lights_set_ = true;
}

void SceneStore::remove(LightId light) {
    if (lights_.remove(light)) lights_anew_ = true;
}

std::uint32_t SceneStore::light_index(LightId id) const {
    const StoredLight* light = lights_.find(id);
    return light ? light->item : kNone;
}

LightId SceneStore::light_at(std::uint32_t index) const {
    const ecs::Entity entity = snapshot_.lights[index].entity;
    return {entity.index, entity.version};
}

void SceneStore::list_lights() {
    std::vector<LightItem> before = std::exchange(snapshot_.lights, {});
    std::erase_if(dropped_, [](const Dropped& dropped) { return static_cast<bool>(dropped.light); });
    lights_.each([&](LightId id, StoredLight& light) {
        light.item = kNone;
        light.set = true;
        DropReason fault;
        if (!can_shine(light.desc, fault)) return dropped_.push_back({{}, id, reason_code(fault)});
        light.item = static_cast<std::uint32_t>(snapshot_.lights.size());
        const auto was = std::find_if(before.begin(), before.end(),
                                      [&](const LightItem& item) { return item.entity == entity_of(id); });
        snapshot_.lights.push_back(was != before.end() ? std::move(*was) : LightItem{});
        snapshot_.lights.back().entity = entity_of(id);
        snapshot_.lights.back().name = light.desc.name.empty() ? "light" + std::to_string(id.index) : light.desc.name;
    });
    make_names_unique(snapshot_.lights);
    lights_set_ = true;
}

/// Applies set lights in place. Returns whether any differs.
bool SceneStore::put_lights() {
    bool any = false;
    lights_.each([&](LightId, StoredLight& light) {
        if (!light.set || light.item == kNone) return;
        light.set = false;
        any |= put_light(light.desc, light.tuning, snapshot_.version, snapshot_.lights[light.item]);
    });
    return any;
}

}  // namespace gnomon::embed
