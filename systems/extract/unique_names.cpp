#include "systems/extract/unique_names.h"

#include <set>
#include <string>

namespace gnomon {

void make_names_unique(std::vector<LightItem>& lights) {
    std::set<std::string> taken;
    for (LightItem& light : lights) {
        const std::string base = light.name;
        for (int n = 1; !taken.insert(light.name).second; ++n) light.name = base + "." + std::to_string(n);
    }
}

}  // namespace gnomon
