#include "systems/extract/names.h"

#include <set>

#include "gnomon/components.h"

namespace gnomon {

std::string name_of(const ecs::Registry& registry, ecs::Entity e) {
    const Name* name = registry.get<Name>(e);
    return name && !name->text.empty() ? name->text : "entity" + std::to_string(e.index);
}

void make_names_unique(std::vector<LightItem>& lights) {
    std::set<std::string> taken;
    for (LightItem& light : lights) {
        const std::string wish = light.name;
        for (int n = 1; !taken.insert(light.name).second; ++n) light.name = wish + "." + std::to_string(n);
    }
}

}  // namespace gnomon
