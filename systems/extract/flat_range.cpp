#include "systems/extract/flat_range.h"

#include <algorithm>
#include <cmath>

#include "systems/extract/scene_tree.h"
#include "systems/extract/volumes.h"

namespace gnomon {
namespace {

constexpr double kLeastSteps = 8.0;
constexpr double kRounding = 1.0 / 4096.0;  // relative to the range; covers clipping in float

/// Returns the least distance along `way` from the camera to anything in its view; infinity without any.
double nearest_m(const SceneSnapshot& scene, const ConsumerItem& camera, const glm::dvec3& way,
                 std::vector<glm::dvec3>& corners_ws_m) {
    const math::Frustum seen = consumer_frustum(camera);
    const auto of_box = [&](const math::Aabb& box) {
        return glm::dot(way, math::centre(box) - camera.position_ws_m) -
               glm::dot(glm::abs(way), math::half_extent(box));
    };
    const auto of_seen_part = [&](std::uint32_t i, double lowest_m) {
        corners_ws_m.clear();
        math::clip_box(seen, scene.instances[i].bounds_ws, corners_ws_m);
        for (const glm::dvec3& corner : corners_ws_m)
            lowest_m = std::min(lowest_m, glm::dot(way, corner - camera.position_ws_m));
        return lowest_m;
    };
    return lowest_of_instances(scene, of_box, of_seen_part);
}

}  // namespace

ViewRange flat_range(const SceneSnapshot& scene, const ConsumerItem& camera) {
    std::vector<glm::dvec3> corners_ws_m;
    return flat_range(scene, camera, corners_ws_m);
}

ViewRange flat_range(const SceneSnapshot& scene, const ConsumerItem& camera, std::vector<glm::dvec3>& corners_ws_m) {
    const glm::dvec3 back = camera.rotation_ws[2];
    const double least_m = nearest_m(scene, camera, -back, corners_ws_m);
    const double most_m = -nearest_m(scene, camera, back, corners_ws_m);
    if (!(least_m <= most_m)) return {camera.near_m, camera.far_m};
    // A surface perpendicular to the view has no extent along it; the view's height stands for the scale.
    const double extent_m = std::max(most_m - least_m, camera.half_height_m);
    const double step_m = std::exp2(std::floor(std::log2(extent_m / kLeastSteps)));
    const double rounding_m = kRounding * extent_m;
    return {std::max(camera.near_m, step_m * std::floor((least_m - rounding_m) / step_m)),
            std::min(camera.far_m, step_m * std::ceil((most_m + rounding_m) / step_m))};
}

}  // namespace gnomon
