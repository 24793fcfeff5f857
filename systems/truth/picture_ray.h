#pragma once
#include <glm/vec2.hpp>
#include <limits>

#include "systems/extract/volumes.h"

namespace gnomon::truth {

/// Ray from + t * along, for t from `first` to `last`.
struct PictureRay {
    glm::dvec3 from_ws_m{0.0}, along{0.0};
    double first = 0.0, last = std::numeric_limits<double>::infinity();
};

/// Returns the ray through `at_px`; integers are pixel centres, row 0 is the lowest.
inline PictureRay picture_ray(const ConsumerItem& camera, const glm::dvec2& at_px) {
    const glm::dvec2 size(camera.viewport_px);
    const glm::dvec2 ndc = 2.0 * (at_px + 0.5) / size - 1.0;
    const bool perspective = camera.projection == CameraProjection::perspective;
    const double half_height = half_extent(camera).y;
    const glm::dvec3 across =
        camera.rotation_ws[0] * (ndc.x * half_height * size.x / size.y) + camera.rotation_ws[1] * (ndc.y * half_height);
    const glm::dvec3 forward = -camera.rotation_ws[2];
    if (perspective) return {camera.position_ws_m, across + forward, camera.near_m, camera.far_m};
    // Starts at the near plane, which may lie behind an orthographic camera.
    return {camera.position_ws_m + across + forward * camera.near_m, forward, 0.0, camera.far_m - camera.near_m};
}

}  // namespace gnomon::truth
