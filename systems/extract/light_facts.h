#pragma once
#include <algorithm>
#include <cstddef>
#include <glm/vec3.hpp>
#include <iterator>

#include "gnomon/light.h"
#include "systems/extract/snapshot.h"

/// Facts of light kinds for all stages. What shadows need of a kind is in systems/shadow/request/light_kinds.h.
namespace gnomon {

struct LightFacts {
    LightKind kind;
    bool parallel;  // rays are parallel: the light has no position and no range; its intensity is in lux
    bool cone;      // a cone of LightItem::outer_cone_rad around the light's direction bounds its rays
    float LightItem::*source_size;  // radius of the source: metres, or radians of parallel rays
    float most_source_size;         // upper limit of source_size
};

/// Rows in the order of LightKind.
inline constexpr LightFacts kLightFacts[] = {
    {LightKind::directional, true, false, &LightItem::sun_radius_rad, kMostSunRadius_rad},
    {LightKind::spot, false, true, &LightItem::source_radius_m, kMostSourceRadius_m},
    {LightKind::point, false, false, &LightItem::source_radius_m, kMostSourceRadius_m},
};

constexpr bool light_facts_are_in_order() {
    for (std::size_t i = 0; i < std::size(kLightFacts); ++i)
        if (static_cast<std::size_t>(kLightFacts[i].kind) != i) return false;
    return true;
}
static_assert(light_facts_are_in_order());

constexpr const LightFacts& light_facts(LightKind kind) { return kLightFacts[static_cast<std::size_t>(kind)]; }

/// Returns the direction from a place to the light, with the distance as its length. Parallel rays: a unit vector.
inline glm::dvec3 to_light(const LightItem& light, const glm::dvec3& place_ws_m) {
    return light_facts(light.kind).parallel ? light.rotation_ws[2] : light.position_ws_m - place_ws_m;
}

/// Returns the illuminance at a squared distance, lux, by the strongest colour channel. Parallel rays: the same at any
/// distance.
inline double illuminance_lux(const LightItem& light, double distance_m2) {
    const float brightest = std::max({light.colour.r, light.colour.g, light.colour.b});
    const double emitted = static_cast<double>(light.intensity) * static_cast<double>(brightest);
    return light_facts(light.kind).parallel ? emitted : emitted / distance_m2;
}

}  // namespace gnomon
