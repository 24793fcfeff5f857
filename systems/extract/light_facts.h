#pragma once
#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <iterator>

#include "gnomon/light.h"
#include "systems/extract/snapshot.h"

/// Facts of light kinds for all stages. What shadows need of a kind is in systems/shadow/request/light_kinds.h.
namespace gnomon {

/// Shape of a light's source. `facing`: a disk that faces every receiver.
enum class SourceShape : unsigned char { facing, rectangle, disc, sphere, tube };

struct LightFacts {
    LightKind kind;
    bool parallel;  // rays are parallel: the light has no position and no range; its intensity is in lux
    bool cone;      // a cone of LightItem::outer_cone_rad around the light's direction bounds its rays
    float LightItem::*source_size;  // radius of the source: metres, or radians of parallel rays
    float most_source_size;         // upper limit of source_extent()
    SourceShape shape = SourceShape::facing;
    bool half_space = false;  // it shines from one side of its plane, along -back
    double flux_share = 1.0;  // flux of a small source, by that of a point as bright as its brightest side

    /// Returns true if its source is a surface, with an intensity in nits.
    constexpr bool area() const { return shape != SourceShape::facing; }
    /// Returns true if the light's direction counts.
    constexpr bool aimed() const { return parallel || cone || (area() && shape != SourceShape::sphere); }
};

/// Largest distance of an area light's place from its middle, metres: corners of the largest rectangle.
inline constexpr float kMostSourceReach_m = 1.5f * kMostSourceRadius_m;

/// Rows in the order of LightKind.
inline constexpr LightFacts kLightFacts[] = {
    {LightKind::directional, true, false, &LightItem::sun_radius_rad, kMostSunRadius_rad},
    {LightKind::spot, false, true, &LightItem::source_radius_m, kMostSourceRadius_m},
    {LightKind::point, false, false, &LightItem::source_radius_m, kMostSourceRadius_m},
    // Flux: a Lambertian plane's is pi times its brightest intensity, a cylinder's pi * pi times.
    {LightKind::rectangle, false, false, &LightItem::source_radius_m, kMostSourceReach_m, SourceShape::rectangle, true,
     0.25},
    {LightKind::disc, false, false, &LightItem::source_radius_m, kMostSourceReach_m, SourceShape::disc, true, 0.25},
    {LightKind::sphere, false, false, &LightItem::source_radius_m, kMostSourceReach_m, SourceShape::sphere},
    {LightKind::tube, false, false, &LightItem::source_radius_m, kMostSourceReach_m, SourceShape::tube, false,
     0.785398163},
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

/// Returns the area that an area light shows where it shows most, square metres. 1 for other lights.
double shown_area_m2(const LightItem& light);

/// Returns the size of the light's source: radians of parallel rays, else metres. An area light's is the distance of
/// its farthest place from its middle.
float source_extent(const LightItem& light);

/// Returns an upper bound of the illuminance at a squared distance from the light's middle, lux, by the strongest
/// colour channel. Parallel rays: the same at any distance.
double illuminance_lux(const LightItem& light, double distance_m2);

/// Returns true unless the place lies behind the plane of a light that shines from one side. `to_light`: its way to the
/// light's middle.
inline bool is_shone_on(const LightItem& light, const glm::dvec3& to_light) {
    return !light_facts(light.kind).half_space || glm::dot(light.rotation_ws[2], to_light) > 0.0;
}

}  // namespace gnomon
