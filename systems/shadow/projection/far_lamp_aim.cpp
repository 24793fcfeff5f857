#include "systems/shadow/projection/far_lamp_aim.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/math/frustum.h"
#include "systems/extract/light_facts.h"
#include "systems/extract/scene_tree.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/projection/light_range.h"

namespace gnomon::shadow {
namespace {

/// Of what is seen, as the lamp sees it: half its angle's sine below which a point's map is aimed. A cube's face is 1.
constexpr double kPointAims = 1.0 / 16.0;
/// The same of a spot, of its cone's tangent: what held_rectangle() can still crop to.
constexpr double kSpotAims = 1.0 / 64.0;
/// And of any: the rounding of a float matrix about the lamp, 2^-24, is then 2^-16 of the map, a 16th of a texel of
/// 8192.
constexpr double kAlwaysAims = 1.0 / 256.0;
constexpr double kLeaves = 2.0;      // times that
constexpr double kWidestBall = 0.6;  // sine of half the angle of a ball: that of a new one is half at most
constexpr double kSpareSize = 4.0;   // of a new ball against what is seen: the camera may turn and walk in it
constexpr double kMostSpare = 32.0;  // of a held one; half of what held_rectangle() crops
/// Least radius for a metre of distance: positions are known to 2^-47 of it (math::kClippedRounding).
constexpr double kLeastRadius = 0x1p-30;
/// A ball that is held keeps so much of its radius free, against rounding.
constexpr double kFree = 1.0 / 1024.0;

double aims_below(const LightItem& light) {
    if (!light_facts(light.kind).cone) return kPointAims;
    return std::max(kAlwaysAims, kSpotAims * std::min(std::tan(light.outer_cone_rad), 1.0));
}

/// Around the parts of receivers that some consumer sees and the light reaches. Stops, with whatever it has, at one
/// that stands around the light: no ball that holds it is seen at a small angle.
math::Aabb lit_box(const SceneSnapshot& scene, const LightItem& light) {
    const LightReach reach(light);
    math::Aabb lit;
    bool around = false;
    for (const ConsumerItem& consumer : scene.consumers) {
        const math::Frustum frustum = consumer_frustum(consumer);
        const auto planes = math::planes_of(frustum);
        const auto classify = [&](const math::Aabb& box) {
            if (around) return math::Overlap::outside;
            const math::Overlap seen = math::overlap(planes, box);
            if (seen == math::Overlap::outside) return seen;
            const math::Overlap reached = reach.overlap(box);
            return reached == math::Overlap::inside ? seen : reached;
        };
        visit_instances(scene, classify, [&](std::uint32_t i) {
            const InstanceItem& item = scene.instances[i];
            if (!item.visible || !receives_under(light, item)) return;
            const math::Aabb reached = math::clipped_bounds(reach.cone(), reach.clipped(item.bounds_ws));
            const math::Aabb box = math::clipped_bounds(planes, reached);
            if (math::is_empty(box)) return;
            lit = math::merged(lit, box);
            const double distance_m = glm::distance(math::centre(box), light.position_ws_m);
            around = around || glm::length(math::half_extent(box)) > distance_m;
        });
    }
    return lit;
}

}  // namespace

LampAim next_lamp_aim(const SceneSnapshot& scene, const LightItem& light, const LampAim& held) {
    if (light_facts(light.kind).parallel || !light.has_shadow) return {};
    const math::Aabb lit = lit_box(scene, light);
    const bool fits = held.used && held.radius_m <= kWidestBall * glm::distance(held.middle_ws_m, light.position_ws_m);
    if (math::is_empty(lit)) return fits ? held : LampAim{};
    const glm::dvec3 middle_ws_m = math::centre(lit);
    const double distance_m = glm::distance(middle_ws_m, light.position_ws_m);
    const double radius_m = std::max(glm::length(math::half_extent(lit)), kLeastRadius * distance_m);
    const double begins = aims_below(light) * distance_m;
    if (!(radius_m <= (held.used ? kLeaves : 1.0) * begins) || !std::isfinite(distance_m)) return {};
    const bool holds = glm::distance(middle_ws_m, held.middle_ws_m) + radius_m <= held.radius_m * (1.0 - kFree);
    if (fits && holds && held.radius_m <= kMostSpare * radius_m) return held;
    return {true, middle_ws_m, kSpareSize * radius_m};
}

LightOpening aimed_opening(const LightItem& light, const LampAim& aim) {
    const glm::dvec3 back = light.position_ws_m - aim.middle_ws_m;
    const double sine = aim.radius_m / glm::length(back);
    LightOpening opening;
    opening.axes = math::basis_from_back(back);
    opening.high = glm::dvec2(sine / std::sqrt(1.0 - sine * sine));
    opening.low = -opening.high;
    opening.held_as = kAimedView;
    return opening;
}

}  // namespace gnomon::shadow
