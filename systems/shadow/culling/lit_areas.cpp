#include "systems/shadow/culling/lit_areas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "engine/math/cone.h"
#include "systems/extract/light_facts.h"
#include "systems/extract/scene_tree.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/culling/occluders.h"
#include "systems/shadow/frame/light_jobs.h"
#include "systems/shadow/projection/light_range.h"
#include "systems/shadow/projection/screen_bounds.h"

namespace gnomon::shadow {
namespace {

/// Planes of a pyramid with four sides around a cone: every third of those with twelve, and the one behind its apex.
std::array<math::Plane, 5> pyramid_around(std::span<const math::Plane> cone) {
    static_assert(math::kConeSides == 12);
    return {cone[0], cone[3], cone[6], cone[9], cone[math::kConeSides]};
}

/// Finds the corners of all visible instances in the camera's frustum and the light's reach. Returns false if these are
/// more than kMostLitInstances.
bool clip_lit_instances(const SceneSnapshot& scene, const LightItem& light, const ConsumerItem& camera,
                        SetScratch& scratch) {
    const LightReach reach(light);
    const math::Frustum frustum = consumer_frustum(camera);
    const auto of_camera = math::planes_of(frustum);
    const SeenReach seen(of_camera, reach);
    std::vector<std::uint32_t>& found = scratch.candidates;
    found.clear();
    const auto classify = [&](const math::Aabb& box, math::OpenTests& open) {
        return found.size() > kMostLitInstances ? math::Overlap::outside : seen.overlap(box, open);
    };
    visit_instances(scene, seen.tests(), classify, [&](std::uint32_t i) {
        if (scene.instances[i].visible && found.size() <= kMostLitInstances) found.push_back(i);
    });
    if (found.size() > kMostLitInstances) return false;
    std::array<math::Plane, math::kMaxClipPlanes> planes;
    auto end = std::copy(of_camera.begin(), of_camera.end(), planes.begin());
    const std::span<const math::Plane> cone = reach.cone();
    if (cone.size() > math::kConeSides) {
        const auto pyramid = pyramid_around(cone);
        end = std::copy(pyramid.begin(), pyramid.end(), end);
    } else {
        end = std::copy(cone.begin(), cone.end(), end);
    }
    const auto used = std::span<const math::Plane>(planes.begin(), end);
    for (const std::uint32_t i : found)
        math::clip_box(used, reach.clipped(scene.instances[i].bounds_ws), scratch.points_ws);
    return true;
}

/// Rectangle around points on screen, in pixels, and their greatest distance along the view.
struct SeenBounds {
    glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    double farthest_m = -std::numeric_limits<double>::infinity();
};

/// Computes the bounds of what of the points is before the camera. Points of other cameras may be elsewhere.
SeenBounds bounds_of(std::span<const glm::dvec3> points_ws, const ConsumerItem& c) {
    const bool orthographic = c.projection == CameraProjection::orthographic;
    const glm::dvec2 half = half_extent(c), half_px = 0.5 * glm::dvec2(c.viewport_px);
    SeenBounds bounds;
    for (const glm::dvec3& point : points_ws) {
        const glm::dvec3 p = (point - c.position_ws_m) * c.rotation_ws;  // view axes
        // Corners that this camera sees are not nearer than its near plane, up to rounding.
        if (!orthographic && !(-p.z > 0.5 * c.near_m)) continue;
        const glm::dvec2 at_px = (glm::dvec2(p) / (half * (orthographic ? 1.0 : -p.z)) + 1.0) * half_px;
        bounds.low = glm::min(bounds.low, at_px);
        bounds.high = glm::max(bounds.high, at_px);
        bounds.farthest_m = std::max(bounds.farthest_m, -p.z);
    }
    return bounds;
}

/// Returns the pixels of `within` that the bounds touch, on the grid of areas.
gl::Rect on_grid(const SeenBounds& bounds, const gl::Rect& within, const glm::uvec2& viewport_px) {
    const glm::dvec2 size(viewport_px), least(within.x, within.y);
    const glm::dvec2 most = least + glm::dvec2(within.width, within.height);
    const auto step = [](const glm::dvec2& px) { return px / kAreaStep_px; };
    const glm::dvec2 low = glm::floor(step(glm::clamp(bounds.low - kRasterMargin_px, 0.0, 1.0e9))) * kAreaStep_px;
    const glm::dvec2 high = glm::ceil(step(glm::clamp(bounds.high + kRasterMargin_px, 0.0, 1.0e9))) * kAreaStep_px;
    const glm::dvec2 from = glm::max(low, least), to = glm::min(glm::min(high, size), most);
    if (!(from.x < to.x && from.y < to.y)) return {};
    return {static_cast<std::int32_t>(from.x), static_cast<std::int32_t>(from.y),
            static_cast<std::int32_t>(to.x - from.x), static_cast<std::int32_t>(to.y - from.y)};
}

/// Returns whether all that the light lights are its receivers, and few enough.
bool receivers_bound(const LightItem& light, const LightSets& sets, const InstanceLayers& layers) {
    const bool searched = sets.hulls.count > 0;
    return searched && sets.receiver_points.count <= kMostLitCorners && layers.all_show_shadows_of(light);
}

}  // namespace

LitArea area_in_range(const LightItem& light, const ConsumerItem& camera) {
    const gl::Rect reach = screen_rectangle(light, camera);
    const float depth = farthest_depth(light, camera);
    return {reach, depth, reach, depth};
}

LitArea lit_area(const SceneSnapshot& scene, std::uint32_t light, const ConsumerItem& camera,
                 const ReceiverCasterSets* searched, SetScratch& scratch) {
    const LightItem& item = scene.lights[light];
    // The range is the cheapest test, and most of many lights are off screen.
    LitArea area = area_in_range(item, camera);
    if (area.screen.width == 0 || light_facts(item.kind).parallel) return area;
    std::span<const glm::dvec3> corners_ws;
    if (searched && receivers_bound(item, searched->lights[light], *scratch.layers)) {
        corners_ws = slice(searched->receiver_points_ws, searched->lights[light].receiver_points);
    } else {
        scratch.points_ws.clear();
        if (!clip_lit_instances(scene, item, camera, scratch)) return area;
        corners_ws = scratch.points_ws;
    }
    if (searched && are_hidden(searched->occluders, corners_ws)) corners_ws = {};
    const SeenBounds bounds = bounds_of(corners_ws, camera);
    area.screen = on_grid(bounds, area.screen, camera.viewport_px);
    if (area.screen.width > 0)
        area.farthest_depth = std::max(area.farthest_depth, depth_bound(bounds.farthest_m, camera));
    return area;
}

void find_lit_areas(const SceneSnapshot& scene, Jobs* jobs, StageStorage& storage, ReceiverCasterSets& sets) {
    const std::vector<ConsumerItem>& cameras = scene.pictures.empty() ? scene.consumers : scene.pictures;
    const auto is_searched = [&](std::size_t c) {
        return scene.pictures.empty() || (c < scene.consumers.size() && cameras[c] == scene.consumers[c]);
    };
    const std::size_t lights = scene.lights.size();
    sets.lit_areas.resize(cameras.size() * lights);
    for_each_light(jobs, lights, [&](std::size_t light, std::size_t thread) {
        for (std::size_t c = 0; c < cameras.size(); ++c)
            sets.lit_areas[c * lights + light] =
                lit_area(scene, static_cast<std::uint32_t>(light), cameras[c], is_searched(c) ? &sets : nullptr,
                         storage.scratch[thread].sets);
    });
}

}  // namespace gnomon::shadow
