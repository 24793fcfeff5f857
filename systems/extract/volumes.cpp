#include "systems/extract/volumes.h"

#include <cmath>

namespace gnomon {
namespace {

math::Frustum frustum_from(const glm::dvec3& place_m, const ConsumerItem& c, double near_m, double far_m) {
    const glm::dvec2 half = half_extent(c);
    return c.projection == CameraProjection::orthographic
               ? math::orthographic_frustum(place_m, c.rotation_ws, half.x, half.y, near_m, far_m)
               : math::perspective_frustum(place_m, c.rotation_ws, half.x, half.y, near_m, far_m);
}

}  // namespace

double aspect(const ConsumerItem& consumer) {
    return static_cast<double>(consumer.viewport_px.x) / static_cast<double>(consumer.viewport_px.y);
}

glm::dvec2 half_extent(const ConsumerItem& c) {
    const double half_y =
        c.projection == CameraProjection::orthographic ? c.half_height_m : std::tan(0.5 * c.fov_y_rad);
    return {half_y * aspect(c), half_y};
}

double squared_corner_slant(const ConsumerItem& c) {
    const glm::dvec2 half = half_extent(c);
    return 1.0 + half.x * half.x + half.y * half.y;
}

math::Frustum consumer_frustum(const ConsumerItem& c) { return frustum_from(c.position_ws_m, c, c.near_m, c.far_m); }

math::Frustum consumer_frustum(const ConsumerItem& c, double near_m) {
    return frustum_from(c.position_ws_m, c, near_m, c.far_m);
}

math::Frustum consumer_frustum(const ConsumerItem& c, double near_m, double far_m) {
    return frustum_from(c.position_ws_m, c, near_m, far_m);
}

math::Frustum consumer_frustum_at_origin(const ConsumerItem& c) {
    return frustum_from(glm::dvec3(0.0), c, c.near_m, c.far_m);
}

math::Frustum pyramid(const glm::dvec3& apex_ws_m, const glm::dmat3& rotation_ws, double tan_half, double far_m) {
    return math::perspective_frustum(apex_ws_m, rotation_ws, tan_half, tan_half, 0.0, far_m);
}

double pixel_footprint(const ConsumerItem& c) { return 2.0 * half_extent(c).y / static_cast<double>(c.viewport_px.y); }

}  // namespace gnomon
