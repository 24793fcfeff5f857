#pragma once
#include <string>
#include <vector>

#include "engine/ecs/registry.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// As reports name it: by its Name, or "entity" and its index.
std::string name_of(const ecs::Registry& registry, ecs::Entity e);

/// Reports and files name lights: a repeated name gets .1, .2, …
void make_names_unique(std::vector<LightItem>& lights);

}  // namespace gnomon
