#include <cmath>
#include <glm/geometric.hpp>

#include "engine/math/projection.h"
#include "systems/shadow/kinds/perspective_range.h"
#include "systems/shadow/light_kinds.h"

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
    const PerspectiveRange range = perspective_range(nearest, farthest);
    if (!(range.near_m < range.far_m) || !std::isfinite(range.far_m)) return false;

    ShadowView view;
    view.projection = ViewProjection::perspective;
    view.anchor_ws_m = light.position_ws_m;
    view.axis_u = light.rotation_ws[0];
    view.axis_v = light.rotation_ws[1];
    view.axis_back = light.rotation_ws[2];
    view.near_m = range.near_m;
    view.far_m = range.far_m;
    const double size_px = input.demand.resolution_px;
    const double margin_px = std::ceil(static_cast<double>(input.reach_texel)) + 1.0;
    const double half =
        std::tan(std::min(light.outer_cone_rad, kWidestMap_rad)) * size_px / (size_px - 2.0 * margin_px);
    view.texel_u = view.texel_v = 2.0 * half / size_px;
    view.depth_alpha = -range.near_m / (range.far_m - range.near_m);
    view.depth_beta = range.near_m * range.far_m / (range.far_m - range.near_m);

    const glm::dmat4 view_from_anchor(glm::transpose(light.rotation_ws));
    const glm::dmat4 clip_from_anchor =
        math::reversed_perspective(-half, half, -half, half, range.near_m, range.far_m) * view_from_anchor;
    view.clip_from_anchor = glm::mat4(clip_from_anchor);
    view.map_from_anchor = glm::mat4(math::texture_from_clip() * clip_from_anchor);
    views.push_back(view);
    return true;
}

}  // namespace gnomon::shadow
