#pragma once
#include <string>

#include "gnomon/registry.h"

namespace gnomon {

/// Returns the entity's name in reports: its Name, or "entity" and its index.
std::string name_of(const ecs::Registry& registry, ecs::Entity e);

}  // namespace gnomon
