#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "gnomon/registry.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// Fills SceneSnapshot::lights and ::consumers and updates them entity by entity. The cost is independent of instances.
class LightsAndCameras {
public:
    /// Rebuilds both lists after additions or removals. An unchanged light keeps its versions; others get
    /// `snapshot.version`.
    void list(const ecs::Registry& registry, glm::uvec2 viewport_px, SceneSnapshot& snapshot);

    enum class Effect : std::uint8_t {
        none,     // nothing changed
        changed,  // updated in place
        listing   // added or removed: call list()
    };
    /// Brings in what a Light, LightShadow, ShadowTuning, Camera or WorldTransform of this entity contains, after it
    /// was written or removed. Costs no more than finding it among the lights and cameras.
    Effect touch(const ecs::Registry& registry, ecs::Entity entity, SceneSnapshot& snapshot) const;

    /// Updates names after a Name of these was written or removed. Names are made unique, so that one may change
    /// others.
    Effect rename(const ecs::Registry& registry, std::span<const ecs::Entity> named, SceneSnapshot& snapshot) const;

    /// Returns the unusable entities that list() found.
    std::span<const DroppedEntity> unusable() const { return unusable_; }

private:
    std::vector<DroppedEntity> unusable_;
};

}  // namespace gnomon
