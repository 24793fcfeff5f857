#include "systems/shadow/culling/occluders.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "systems/extract/scene_tree.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/projection/screen_bounds.h"

namespace gnomon::shadow {
namespace {

/// Returns how large a box looks: its diagonal over its distance. Infinite around the eye.
double size_rad(const math::Aabb& box, const glm::dvec3& eye_ws_m) {
    const double diagonal_m = glm::length(box.max - box.min), distance_m = math::distance(box, eye_ws_m);
    return distance_m > 0.0 ? diagonal_m / distance_m : std::numeric_limits<double>::infinity();
}

/// Returns the distance of the near plane's farthest corner from the camera.
double near_reach_m(const ConsumerItem& camera) { return camera.near_m * std::sqrt(squared_corner_slant(camera)); }

/// Returns the instance's occluder; with an empty box if it is none.
Occluder occluder_of(const InstanceItem& item, const math::Aabb& inner_ms, const ConsumerItem& camera) {
    Occluder occluder;
    occluder.eye_ws_m = camera.position_ws_m;
    occluder.from_world = glm::inverse(item.basis);
    occluder.eye_ms = occluder.from_world * (camera.position_ws_m - item.translation_ws_m);
    const double margin_m =
        kRasterMargin_px * pixel_footprint(camera) * math::farthest_distance(item.bounds_ws, camera.position_ws_m);
    const glm::dmat3 rows = glm::transpose(occluder.from_world);
    const glm::dvec3 margin_ms =
        margin_m * glm::dvec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    occluder.box_ms = {inner_ms.min + margin_ms, inner_ms.max - margin_ms};
    return occluder;
}

/// Returns whether the box lies between the camera and the point.
bool hides(const Occluder& occluder, const glm::dvec3& point_ws_m) {
    const glm::dvec3 way = occluder.from_world * (point_ws_m - occluder.eye_ws_m);
    double enters = 0.0, leaves = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = occluder.box_ms.min[axis] - occluder.eye_ms[axis];
        const double high = occluder.box_ms.max[axis] - occluder.eye_ms[axis];
        if (way[axis] == 0.0) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        const double to_low = low / way[axis], to_high = high / way[axis];
        enters = std::max(enters, std::min(to_low, to_high));
        leaves = std::min(leaves, std::max(to_low, to_high));
    }
    return enters <= leaves;
}

bool is_larger(const Occluder& a, const Occluder& b) {
    return a.size_rad != b.size_rad ? a.size_rad > b.size_rad : a.instance < b.instance;
}

/// Puts an occluder in its place among the largest ones.
void put(const Occluder& found, std::vector<Occluder>& largest) {
    if (largest.size() == kMostOccluders && !is_larger(found, largest.back())) return;
    if (largest.size() == kMostOccluders) largest.pop_back();
    largest.insert(std::upper_bound(largest.begin(), largest.end(), found, is_larger), found);
}

}  // namespace

void find_occluders(const SceneSnapshot& scene, const ConsumerItem& camera, std::vector<Occluder>& occluders) {
    occluders.clear();
    if (scene.meshes.inner_boxes_ms.empty() || camera.projection != CameraProjection::perspective) return;
    const math::Frustum frustum = consumer_frustum(camera);
    const glm::dvec3& eye = camera.position_ws_m;
    const double near_m = near_reach_m(camera);
    const auto classify = [&](const math::Aabb& box) {
        const bool counts = size_rad(box, eye) >= kLeastOccluder_rad && math::may_overlap(frustum, box);
        return counts ? math::Overlap::partial : math::Overlap::outside;
    };
    visit_instances(scene, classify, [&](std::uint32_t i) {
        const InstanceItem& item = scene.instances[i];
        const math::Aabb inner_ms = inner_box_of(scene.meshes, item.mesh);
        if (math::is_empty(inner_ms) || !shows_surface(item) || item.drawable.by_depth) return;
        const double looks_rad = size_rad(item.bounds_ws, eye);
        if (looks_rad < kLeastOccluder_rad || !(math::distance(item.bounds_ws, eye) > near_m)) return;
        Occluder found = occluder_of(item, inner_ms, camera);
        found.instance = i;
        found.size_rad = looks_rad;
        if (!math::is_empty(found.box_ms)) put(found, occluders);
    });
}

bool are_hidden(std::span<const Occluder> occluders, std::span<const glm::dvec3> points_ws_m) {
    if (points_ws_m.empty()) return false;
    return std::any_of(occluders.begin(), occluders.end(), [&](const Occluder& occluder) {
        return std::all_of(points_ws_m.begin(), points_ws_m.end(),
                           [&](const glm::dvec3& point) { return hides(occluder, point); });
    });
}

}  // namespace gnomon::shadow
