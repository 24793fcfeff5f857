#include "systems/extract/light_facts.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace gnomon {

double shown_area_m2(const LightItem& light) {
    const double radius_m = light.source_radius_m, width_m = light.width_m, height_m = light.height_m;
    switch (light_facts(light.kind).shape) {
        case SourceShape::facing:
            return 1.0;
        case SourceShape::rectangle:
            return width_m * height_m;
        case SourceShape::disc:
        case SourceShape::sphere:
            return glm::pi<double>() * radius_m * radius_m;
        case SourceShape::tube:
            return 2.0 * radius_m * width_m;
    }
    return 1.0;
}

float source_extent(const LightItem& light) {
    const LightFacts& facts = light_facts(light.kind);
    const float radius_m = light.*facts.source_size;
    if (facts.shape == SourceShape::rectangle) return 0.5f * std::hypot(light.width_m, light.height_m);
    return facts.shape == SourceShape::tube ? std::hypot(0.5f * light.width_m, radius_m) : radius_m;
}

double illuminance_lux(const LightItem& light, double distance_m2) {
    const float brightest = std::max({light.colour.r, light.colour.g, light.colour.b});
    const double emitted = static_cast<double>(light.intensity) * static_cast<double>(brightest);
    const LightFacts& facts = light_facts(light.kind);
    if (facts.parallel) return emitted;
    if (!facts.area()) return emitted / distance_m2;
    // No place of the source is nearer than this. A whole hemisphere of it gives pi times its luminance.
    const double nearest_m = std::max(std::sqrt(distance_m2) - static_cast<double>(source_extent(light)), 0.0);
    const double most = glm::pi<double>() * emitted;
    return nearest_m > 0.0 ? std::min(emitted * shown_area_m2(light) / (nearest_m * nearest_m), most) : most;
}

}  // namespace gnomon
