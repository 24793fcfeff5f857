#include "systems/lighting/area_table.h"

#include <glm/vec4.hpp>
#include <vector>

#include "systems/filled_buffer.h"

namespace gnomon::lighting {
namespace {

constexpr AreaLobes kLobes[] = {
#include "systems/lighting/area_table.inc"
};

}  // namespace

std::span<const AreaLobes> area_lobes() { return kLobes; }

bool AreaTable::provide(bool wanted) {
    if (!wanted) release();
    if (!wanted || buffer_) return true;
    std::vector<glm::vec4> texels;
    for (const AreaLobes& lobes : kLobes) {
        for (const AreaLobe& lobe : {lobes.reflected, lobes.grazing})
            texels.emplace_back(lobe.lean, lobe.along, lobe.across, lobe.skew);
        texels.emplace_back(lobes.reflected.size, lobes.grazing.size, 0.0f, 0.0f);
    }
    buffer_ = filled_buffer(device_, "area lights' lobes", texels).handle;
    return static_cast<bool>(buffer_);
}

void AreaTable::release() {
    if (buffer_) device_.destroy(buffer_);
    buffer_ = {};
}

}  // namespace gnomon::lighting
