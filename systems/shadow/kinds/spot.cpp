#include <cmath>
#include <glm/geometric.hpp>

#include "systems/shadow/kinds/perspective_view.h"
#include "systems/shadow/light_kinds.h"
#include "systems/shadow/range_override.h"

/// Spot light: one perspective view around the cone, near and far from the casters and receivers in it.
namespace gnomon::shadow {
namespace {

struct Span {
    double lowest, highest;
};

/// Distance along the light's axis of the nearest and farthest point of a box.
Span along_axis(const math::Aabb& box, const glm::dvec3& origin, const glm::dvec3& axis) {
    const double middle = glm::dot(math::centre(box) - origin, axis);
    const double reach = glm::dot(math::half_extent(box), glm::abs(axis));
    return {middle - reach, middle + reach};
}

}  // namespace

bool fit_spot(const FitInput& input, std::vector<ShadowView>& views) {
    const LightItem& light = input.light;
    const glm::dvec3 axis = -light.rotation_ws[2];
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    for (const glm::dvec3& p_ws : input.receiver_points_ws) {
        const double z = glm::dot(p_ws - light.position_ws_m, axis);
        nearest = std::min(nearest, z);
        farthest = std::max(farthest, z);
    }
    for (const std::uint32_t i : input.casters)
        nearest = std::min(nearest, along_axis(input.scene.instances[i].bounds_ws, light.position_ws_m, axis).lowest);
    if (light.range_m > 0.0) farthest = std::min(farthest, light.range_m);
    const PerspectiveRange range = overridden(input.demand, perspective_range(nearest, farthest));
    if (!(range.near_m < range.far_m) || !std::isfinite(range.far_m)) return false;

    const double tan_half = std::tan(std::min(light.outer_cone_rad, kWidestMap_rad));
    views.push_back(perspective_view(light.position_ws_m, light.rotation_ws, tan_half, range,
                                     input.demand.resolution_px, static_cast<double>(input.reach_texel)));
    return true;
}

}  // namespace gnomon::shadow
