#pragma once
#include <string>
#include <vector>

#include "gnomon/registry.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// Returns the entity's name in reports: its Name, or "entity" and its index.
std::string name_of(const ecs::Registry& registry, ecs::Entity e);

/// Makes names unique, because reports and files refer to lights by name: a repeated name gets .1, .2, …
void make_names_unique(std::vector<LightItem>& lights);

}  // namespace gnomon
