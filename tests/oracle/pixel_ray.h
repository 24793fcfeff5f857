#pragma once
#include <cmath>
#include <limits>

#include "systems/extract/snapshot.h"
#include "tests/oracle/triangle_test.h"

namespace gnomon::oracle {

struct PixelRay {
    ExactRay ray;
    double t_min = 0.0, t_max = std::numeric_limits<double>::infinity();
};

/// Returns the ray along which the camera sees at `at_px`, a place in the picture. Whole numbers are pixel centres, row
/// 0 is the lowest.
inline PixelRay pixel_ray(const ConsumerItem& consumer, const glm::dvec3& camera_rel_m, const glm::dvec2& at_px) {
    const glm::dvec2 size(consumer.viewport_px);
    const glm::dvec2 ndc = 2.0 * (at_px + 0.5) / size - 1.0;
    const double half_height = consumer.projection == CameraProjection::perspective ? std::tan(0.5 * consumer.fov_y_rad)
                                                                                    : consumer.half_height_m;
    const glm::dvec3 across = consumer.rotation_ws[0] * (ndc.x * half_height * size.x / size.y) +
                              consumer.rotation_ws[1] * (ndc.y * half_height);
    const glm::dvec3 forward = -consumer.rotation_ws[2];
    if (consumer.projection == CameraProjection::perspective)
        return {make_ray(camera_rel_m, across + forward), consumer.near_m, consumer.far_m};
    // From the near plane on, which may lie behind an orthographic camera.
    return {make_ray(camera_rel_m + across + forward * consumer.near_m, forward), 0.0,
            consumer.far_m - consumer.near_m};
}

}  // namespace gnomon::oracle
