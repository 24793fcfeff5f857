#pragma once
#include <glm/mat4x4.hpp>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "gnomon/shadows.h"

namespace gnomon {

/// Keeps casters and lights in step with a registry of EnTT's interface: on_construct, on_update, on_destroy, valid and
/// try_get. Listens to three components and touches nothing else; sync() costs in proportion to what changed.
/// Traits reads the engine's components:
/// - `Transform`, `Caster`, `Light`: the components' types
/// - `static glm::dmat4 world(const Transform&)`: the entity's place
/// - `static CasterDesc caster(const Caster&)`: all but world_from_mesh
/// - `static LightDesc light(const Light&, const glm::dmat4& world)`
template <class Registry, class Traits, class Target = Shadows>
class EnttBridge {
public:
    /// The registry's own id of an entity.
    using Entity = typename Registry::entity_type;

    /// Listens to `registry`, which with `shadows` must outlive the bridge. Entities that exist already are taken where
    /// they are announced by touch().
    EnttBridge(Target& shadows, Registry& registry) : shadows_(shadows), registry_(registry) {
        each_signal([this](auto signal) { signal.template connect<&EnttBridge::note>(*this); });
    }
    ~EnttBridge() {
        each_signal([this](auto signal) { signal.disconnect(this); });
    }
    EnttBridge(const EnttBridge&) = delete;
    EnttBridge& operator=(const EnttBridge&) = delete;

    /// Announces an entity with components that were changed in place, without a signal.
    void touch(Entity entity) { touched_.push_back(entity); }

    /// Hands over what changed. Call it once per frame, before Shadows::render().
    void sync() {
        for (const Entity entity : touched_) {
            const bool alive = registry_.valid(entity);
            const auto* place = alive ? registry_.template try_get<typename Traits::Transform>(entity) : nullptr;
            const auto* caster = place ? registry_.template try_get<typename Traits::Caster>(entity) : nullptr;
            const auto* light = place ? registry_.template try_get<typename Traits::Light>(entity) : nullptr;
            CasterDesc desc = caster ? Traits::caster(*caster) : CasterDesc{};
            if (caster) desc.world_from_mesh = Traits::world(*place);
            put(
                casters_, entity, caster != nullptr, [&](CasterId id) { shadows_.set_caster(id, desc); },
                [&] { return shadows_.add_caster(desc); });
            const LightDesc shining = light ? Traits::light(*light, Traits::world(*place)) : LightDesc{};
            put(
                lights_, entity, light != nullptr, [&](LightId id) { shadows_.set_light(id, shining); },
                [&] { return shadows_.add_light(shining); });
        }
        touched_.clear();
    }
    /// Returns the handle of an entity's light; none: it has had none since the last sync().
    LightId light(Entity entity) const { return lights_.contains(entity) ? lights_.at(entity) : LightId{}; }
    /// Returns the handle of an entity's caster; none: it has had none since the last sync().
    CasterId caster(Entity entity) const { return casters_.contains(entity) ? casters_.at(entity) : CasterId{}; }

private:
    template <class Map, class Set, class Add>
    void put(Map& ids, Entity entity, bool wanted, Set&& set, Add&& add) {
        const auto at = ids.find(entity);
        if (at == ids.end()) return wanted ? static_cast<void>(ids.emplace(entity, add())) : void();
        if (wanted) return set(at->second);
        shadows_.remove(at->second);
        ids.erase(at);
    }
    void note(Registry&, Entity entity) { touched_.push_back(entity); }
    template <class Act>
    void each_signal(Act&& act) {
        const auto each = [&]<class Component>(std::type_identity<Component>) {
            act(registry_.template on_construct<Component>());
            act(registry_.template on_update<Component>());
            act(registry_.template on_destroy<Component>());
        };
        each(std::type_identity<typename Traits::Transform>{});
        each(std::type_identity<typename Traits::Caster>{});
        each(std::type_identity<typename Traits::Light>{});
    }

    Target& shadows_;
    Registry& registry_;
    std::vector<Entity> touched_;
    std::unordered_map<Entity, CasterId> casters_;
    std::unordered_map<Entity, LightId> lights_;
};

}  // namespace gnomon
