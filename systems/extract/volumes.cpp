#include "systems/extract/volumes.h"

#include <cmath>

namespace gnomon {

double aspect(const ConsumerItem& consumer) {
    return static_cast<double>(consumer.viewport_px.x) / static_cast<double>(consumer.viewport_px.y);
}

math::Frustum consumer_frustum(const ConsumerItem& c) {
    if (c.projection == CameraProjection::orthographic)
        return math::orthographic_frustum(c.position_ws_m, c.rotation_ws, c.half_height_m * aspect(c), c.half_height_m,
                                          c.near_m, c.far_m);
    const double tan_half = std::tan(0.5 * c.fov_y_rad);
    return math::perspective_frustum(c.position_ws_m, c.rotation_ws, tan_half * aspect(c), tan_half, c.near_m, c.far_m);
}

math::Frustum pyramid(const glm::dvec3& apex_ws_m, const glm::dmat3& rotation_ws, double tan_half, double far_m) {
    return math::perspective_frustum(apex_ws_m, rotation_ws, tan_half, tan_half, 0.0, far_m);
}

double pixel_footprint(const ConsumerItem& c) {
    const double half = c.projection == CameraProjection::orthographic ? c.half_height_m : std::tan(0.5 * c.fov_y_rad);
    return 2.0 * half / static_cast<double>(c.viewport_px.y);
}

}  // namespace gnomon
