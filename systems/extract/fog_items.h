#pragma once
#include <optional>

#include "gnomon/registry.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// Returns true if the entity is a box of fog: its FogVolume is usable, and it has no MeshRef.
bool is_fog(const ecs::Registry& registry, ecs::Entity entity);

/// Writes place and marks of a box of fog into its item. Returns false if it is unusable.
bool put_fog(const ecs::Registry& registry, InstanceItem& item);

/// Returns the entity's box of fog; empty: it has none, no place, or no extent.
std::optional<InstanceItem> fog_instance(const ecs::Registry& registry, ecs::Entity entity);

/// Lists what the boxes of fog among the instances show.
void list_fogs(const ecs::Registry& registry, SceneSnapshot& snapshot);

}  // namespace gnomon
