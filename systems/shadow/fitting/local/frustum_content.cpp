#include "systems/shadow/fitting/local/frustum_content.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "engine/math/frustum.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {
namespace {

/// Returns the four sides, the light's own plane and a far plane at `end_m`.
std::array<math::Plane, 6> planes_of(const ReceiverHull& receiver_hull, const TangentRectangle& frustum, double end_m) {
    const auto plane = [&](const glm::dvec3& normal, double inset_m) {
        return math::Plane{normal, -glm::dot(normal, receiver_hull.origin_ws_m) - inset_m};
    };
    const glm::dvec3 &u = receiver_hull.axes[0], &v = receiver_hull.axes[1], &back = receiver_hull.axes[2];
    return {plane(u + frustum.low.x * back, 0.0),
            plane(-u - frustum.high.x * back, 0.0),
            plane(v + frustum.low.y * back, 0.0),
            plane(-v - frustum.high.y * back, 0.0),
            plane(-back, 0.0),
            plane(back, -end_m)};
}

/// Returns the distance to a box's nearest corner along the axis, metres.
double nearest_m(const ReceiverHull& receiver_hull, const math::Aabb& box_ws) {
    const glm::dvec3& back = receiver_hull.axes[2];
    return glm::dot(receiver_hull.origin_ws_m - math::centre(box_ws), back) -
           glm::dot(math::half_extent(box_ws), glm::abs(back));
}

}  // namespace

FrustumContent visible_content(const FitInput& input, const ReceiverHull& receiver_hull,
                               const TangentRectangle& frustum) {
    FrustumContent content;
    for (const glm::dvec3& p_ws : input.points_of(receiver_hull)) {
        const glm::dvec3 p = (p_ws - receiver_hull.origin_ws_m) * receiver_hull.axes;
        const double z_m = std::max(-p.z, 0.0);
        content.receivers = true;
        content.nearest_m = std::min(content.nearest_m, z_m);
        content.farthest_m = std::max(content.farthest_m, z_m);
        // Rounding may leave a point a little outside; at the apex itself it may lie in any direction.
        const glm::dvec2 tangent = glm::dvec2(p) / z_m;
        const bool directed = z_m > 0.0;
        content.footprint.low =
            glm::min(content.footprint.low, directed ? glm::clamp(tangent, frustum.low, frustum.high) : frustum.low);
        content.footprint.high =
            glm::max(content.footprint.high, directed ? glm::clamp(tangent, frustum.low, frustum.high) : frustum.high);
    }
    return content;
}

void include_casters(const FitInput& input, const ReceiverHull& receiver_hull, const TangentRectangle& frustum,
                     FrustumContent& content) {
    const auto planes = planes_of(receiver_hull, frustum, content.farthest_m);
    std::vector<glm::dvec3>& points_ws = input.scratch.points_ws;
    for (const std::uint32_t c : input.casters) {
        const math::Aabb& box_ws = input.scene.instances[c].bounds_ws;
        if (content.casters && nearest_m(receiver_hull, box_ws) >= content.nearest_m) continue;
        points_ws.clear();
        if (math::clip_box(planes, box_ws, points_ws) == 0) continue;
        content.casters = true;
        for (const glm::dvec3& p_ws : points_ws)
            content.nearest_m = std::min(
                content.nearest_m, std::max(glm::dot(receiver_hull.origin_ws_m - p_ws, receiver_hull.axes[2]), 0.0));
    }
}

}  // namespace gnomon::shadow
