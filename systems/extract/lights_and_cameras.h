#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "engine/ecs/registry.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// Fills SceneSnapshot::lights and ::consumers, and keeps them up to date one by one. Neither looks at an instance.
class LightsAndCameras {
public:
    /// Makes both lists anew: some came or went. A light that is as it was keeps its versions, others get
    /// `snapshot.version`.
    void list(const ecs::Registry& registry, glm::uvec2 viewport_px, SceneSnapshot& snapshot);

    enum class Effect : std::uint8_t {
        none,     // all is as it was
        changed,  // in place
        listing   // it came or went: list() is to be called
    };
    /// Brings in what a Light, LightShadow, ShadowTuning, Camera or WorldTransform of this entity says, after it was
    /// written or removed. Costs no more than finding it among the lights and cameras.
    Effect touch(const ecs::Registry& registry, ecs::Entity entity, SceneSnapshot& snapshot) const;

    /// After a Name of any of these was written or removed. Names are unique, so that one may change others.
    Effect rename(const ecs::Registry& registry, std::span<const ecs::Entity> named, SceneSnapshot& snapshot) const;

    /// Entities that list() found and that cannot be used.
    std::span<const DroppedEntity> unusable() const { return unusable_; }

private:
    std::vector<DroppedEntity> unusable_;
};

}  // namespace gnomon
