#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "systems/shadow/projection/depth_range_override.h"
#include "systems/shadow/projection/perspective_view.h"
#include "systems/shadow/projection/sun_viewpoint.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {

bool fit_perspective_sun(const FitInput& input, const glm::dmat3& basis, std::vector<ShadowView>& views) {
    const SunViewpoint eye = sun_viewpoint(basis, input.receiver_points_ws, input.light.tuning.projection);
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    for (const glm::dvec3& p : input.receiver_points_ws) {
        const double z = glm::dot(eye.position_ws_m - p, basis[2]);
        nearest = std::min(nearest, z);
        farthest = std::max(farthest, z);
    }
    for (const std::uint32_t i : input.casters) {
        const math::Aabb& box = input.scene.instances[i].bounds_ws;
        const double reach = glm::dot(math::half_extent(box), glm::abs(basis[2]));
        nearest = std::min(nearest, glm::dot(eye.position_ws_m - math::centre(box), basis[2]) - reach);
    }
    const PerspectiveRange range = overridden(input.request.projection, perspective_range(nearest, farthest));
    if (!(range.near_m < range.far_m) || !std::isfinite(range.far_m)) return false;
    const double tan_half = std::tan(0.5 * static_cast<double>(input.light.tuning.projection.eye_angle_rad));
    const TangentRectangle square{glm::dvec2(-tan_half), glm::dvec2(tan_half)};
    const double size_px = input.request.map.resolution_px;
    const TangentRectangle sides = with_border(square, size_px, static_cast<double>(input.reach_texel));
    views.push_back(perspective_view(eye.position_ws_m, basis, sides, range, size_px));
    return true;
}

}  // namespace gnomon::shadow
