#include "systems/extract/names.h"

#include "gnomon/components.h"

namespace gnomon {

std::string name_of(const ecs::Registry& registry, ecs::Entity e) {
    const Name* name = registry.get<Name>(e);
    return name && !name->text.empty() ? name->text : "entity" + std::to_string(e.index);
}

}  // namespace gnomon
