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

/// Threshold of aiming for a point light: sine of half the angle at which the lamp sees the visible receivers. The
/// tangent of a cube's face is 1.
constexpr double kPointAims = 1.0 / 16.0;
/// Threshold for a spot, as a share of its cone's tangent: held_rectangle() can still crop to that share.
constexpr double kSpotAims = 1.0 / 64.0;
/// Least threshold of any spot. A float matrix about the lamp rounds by 2^-24, which is then 2^-16 of the map: a 16th
/// of a texel of 8192.
constexpr double kAlwaysAims = 1.0 / 256.0;
constexpr double kLeaves = 2.0;      // factor on the threshold at which aiming ends
constexpr double kWidestBall = 0.6;  // sine of half the angle of a ball that is kept; a new ball's is at most 1/2
constexpr double kSpareSize = 4.0;   // radius of a new ball per radius of the receivers: room for camera movement
constexpr double kMostSpare = 32.0;  // the same ratio at which a kept ball ends; half of what held_rectangle() crops
/// Least radius per metre of distance: positions are known to 2^-47 of it (math::kClippedRounding).
constexpr double kLeastRadius = 0x1p-30;
/// Share of a kept ball's radius that stays free, against rounding.
constexpr double kFree = 1.0 / 1024.0;

double aims_below(const LightItem& light) {
    if (!light_facts(light.kind).cone) return kPointAims;
    return std::max(kAlwaysAims, kSpotAims * std::min(std::tan(light.outer_cone_rad), 1.0));
}

/// Returns whether no box around this one can be aimed at. With the sine s of half the angle at which aiming ends, a
/// ball of radius r at distance d has r <= s d. A box in it, of radius r' at distance d', has r' <= r and d <= d' + r.
bool is_too_wide(const math::Aabb& box, const LightItem& light) {
    constexpr double kRounding = 1.0 + 0x1p-20;
    const double sine = kLeaves * aims_below(light);
    const double distance_m = glm::distance(math::centre(box), light.position_ws_m);
    return glm::length(math::half_extent(box)) > kRounding * sine / (1.0 - sine) * distance_m;
}

/// Returns the bounding box of all parts of receivers that are in some camera's frustum and in the light's range. Stops
/// at a part of them that is too wide to be aimed at: then the box of that part.
math::Aabb lit_box(const SceneSnapshot& scene, const LightItem& light) {
    const LightReach reach(light);
    math::Aabb lit;
    bool wide = false;
    for (const ConsumerItem& consumer : scene.consumers) {
        const math::Frustum frustum = consumer_frustum(consumer);
        const auto planes = math::planes_of(frustum);
        const SeenReach seen(planes, reach);
        const auto classify = [&](const math::Aabb& box, math::OpenTests& open) {
            return wide ? math::Overlap::outside : seen.overlap(box, open);
        };
        visit_instances(scene, seen.tests(), classify, [&](std::uint32_t i) {
            const InstanceItem& item = scene.instances[i];
            if (wide || !item.visible || !receives_under(light, item)) return;
            const math::Aabb reached = math::clipped_bounds(reach.cone(), reach.clipped(item.bounds_ws));
            const math::Aabb box = math::clipped_bounds(planes, reached);
            if (math::is_empty(box)) return;
            lit = math::merged(lit, box);
            wide = is_too_wide(lit, light);
        });
    }
    return lit;
}

}  // namespace

FarLampAim next_far_lamp_aim(const SceneSnapshot& scene, const LightItem& light, const FarLampAim& previous) {
    if (light_facts(light.kind).parallel || !light.has_shadow) return {};
    const math::Aabb lit = lit_box(scene, light);
    const bool fits =
        previous.used && previous.radius_m <= kWidestBall * glm::distance(previous.middle_ws_m, light.position_ws_m);
    if (math::is_empty(lit)) return fits ? previous : FarLampAim{};
    const glm::dvec3 middle_ws_m = math::centre(lit);
    const double distance_m = glm::distance(middle_ws_m, light.position_ws_m);
    const double radius_m = std::max(glm::length(math::half_extent(lit)), kLeastRadius * distance_m);
    const double begins = aims_below(light) * distance_m;
    if (!(radius_m <= (previous.used ? kLeaves : 1.0) * begins) || !std::isfinite(distance_m)) return {};
    const bool holds = glm::distance(middle_ws_m, previous.middle_ws_m) + radius_m <= previous.radius_m * (1.0 - kFree);
    if (fits && holds && previous.radius_m <= kMostSpare * radius_m) return previous;
    return {true, middle_ws_m, kSpareSize * radius_m};
}

LightFrustum aimed_frustum(const LightItem& light, const FarLampAim& aim) {
    const glm::dvec3 back = light.position_ws_m - aim.middle_ws_m;
    const double sine = aim.radius_m / glm::length(back);
    LightFrustum frustum;
    frustum.axes = math::basis_from_back(back);
    frustum.high = glm::dvec2(sine / std::sqrt(1.0 - sine * sine));
    frustum.low = -frustum.high;
    frustum.held_as = kAimedView;
    return frustum;
}

}  // namespace gnomon::shadow
