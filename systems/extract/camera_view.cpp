#include "systems/extract/camera_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/math/frustum.h"
#include "systems/extract/volumes.h"

namespace gnomon {
namespace {

/// Growth up to which a frame counts as wide as the picture. Files store ratios as floats, off by 6e-8 after one
/// division. The tolerance hides less than 1/60 px of 16 384 (ExtractTest, TheFrameThatACameraWasGivenIsSeenWhole).
constexpr double kAspectRounding = 1.0e-6;

bool is_flat(const Camera& camera) { return camera.projection == CameraProjection::orthographic; }

}  // namespace

glm::dmat3 orientation(const glm::dmat3& basis) {
    const glm::dvec3 back = basis[2];
    if (!(glm::length(back) > 0.0)) return glm::dmat3(1.0);
    const glm::dvec3 z =
        glm::normalize(back / glm::max(std::abs(back.x), glm::max(std::abs(back.y), std::abs(back.z))));
    const glm::dvec3 across = glm::cross(basis[1], z);
    if (!(glm::length(across) > 0.0)) return math::basis_from_back(z);
    const glm::dvec3 x = glm::normalize(across);
    return {x, glm::cross(z, x), z};
}

void fit_frame(const Camera& camera, ConsumerItem& consumer) {
    consumer.fov_y_rad = camera.fov_y_rad;
    consumer.half_height_m = camera.half_height_m;
    const double growth = camera.frame_aspect / aspect(consumer);
    if (!(growth > 1.0 + kAspectRounding) || !std::isfinite(growth)) return;
    consumer.fov_y_rad = 2.0 * std::atan(std::tan(0.5 * camera.fov_y_rad) * growth);
    consumer.half_height_m = camera.half_height_m * growth;
}

void set_range(const Camera& camera, ConsumerItem& consumer) {
    consumer.near_m = camera.near_m;
    consumer.far_m = camera.far_m;
    if (!is_flat(camera) || !(camera.near_m < 0.0)) return;
    consumer.near_m = 0.0;
    consumer.far_m = camera.far_m - camera.near_m;
}

void place_camera(const Camera& camera, const WorldTransform& world, ConsumerItem& consumer) {
    consumer.position_ws_m = world.translation_ws_m;
    consumer.rotation_ws = orientation(world.basis);
    if (is_flat(camera) && camera.near_m < 0.0) consumer.position_ws_m -= consumer.rotation_ws[2] * camera.near_m;
    set_range(camera, consumer);
}

}  // namespace gnomon
