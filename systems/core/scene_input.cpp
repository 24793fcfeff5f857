#include "systems/core/scene_input.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <iterator>

#include "engine/math/finite.h"
#include "gnomon/components.h"
#include "systems/extract/camera_view.h"
#include "systems/extract/flat_range.h"
#include "systems/extract/light_facts.h"
#include "systems/extract/scene_tree.h"
#include "systems/extract/usable.h"
#include "systems/shadow/frame/index_range.h"

namespace gnomon::core {
namespace {

// Enumerators of core.h and those of the components that they stand for, in the same order.
constexpr LightKind kLightKinds[] = {LightKind::directional, LightKind::spot, LightKind::point};
constexpr gnomon::LightKind kComponentKinds[] = {gnomon::LightKind::directional, gnomon::LightKind::spot,
                                                 gnomon::LightKind::point};
constexpr ShadowFilter kFilters[] = {ShadowFilter::hard,         ShadowFilter::hardware_2x2, ShadowFilter::pcf_grid,
                                     ShadowFilter::pcf_bilinear, ShadowFilter::poisson,      ShadowFilter::pcss,
                                     ShadowFilter::vsm,          ShadowFilter::evsm4,        ShadowFilter::moments};
constexpr ShadowFit kFits[] = {ShadowFit::tight, ShadowFit::stable, ShadowFit::quantised};
constexpr CascadeSplits kSplits[] = {CascadeSplits::practical, CascadeSplits::uniform, CascadeSplits::logarithmic,
                                     CascadeSplits::manual, CascadeSplits::seen};
constexpr gnomon::DepthFormat kDepthFormats[] = {gnomon::DepthFormat::d32f, gnomon::DepthFormat::d24,
                                                 gnomon::DepthFormat::d16};
static_assert(std::size(kLightKinds) == std::size(kComponentKinds));

/// Returns the entry of an enumerator; the first for a value outside the enumeration.
template <class T, std::size_t Count, class Enum>
T entry(const T (&table)[Count], Enum value) {
    const auto index = static_cast<std::size_t>(value);
    return table[index < Count ? index : 0];
}

/// Returns the box; empty if its numbers have no meaning. The tree never finds an empty one.
math::Aabb bounds_of(const Box& box) {
    const bool usable = math::is_finite(box.min_ws_m) && math::is_finite(box.max_ws_m) &&
                        box.min_ws_m.x <= box.max_ws_m.x && box.min_ws_m.y <= box.max_ws_m.y &&
                        box.min_ws_m.z <= box.max_ws_m.z;
    return usable ? math::Aabb{box.min_ws_m, box.max_ws_m} : math::Aabb{};
}

gnomon::Camera component_of(const Camera& camera) {
    gnomon::Camera out;
    out.projection =
        camera.projection == Projection::orthographic ? CameraProjection::orthographic : CameraProjection::perspective;
    out.fov_y_rad = camera.fov_y_rad;
    out.half_height_m = camera.half_height_m;
    out.near_m = camera.near_m;
    out.far_m = camera.far_m;
    return out;
}

gnomon::Light component_of(const Light& light) {
    gnomon::Light out;
    out.kind = entry(kComponentKinds, light.kind);
    out.intensity = 1.0f;  // what a light looks like is not known here
    out.range_m = light.range_m;
    out.outer_cone_rad = light.outer_cone_rad;
    out.source_radius_m = light.source_radius_m;
    out.sun_radius_rad = light.sun_radius_rad;
    return out;
}

LightShadow shadow_of(const Light& light) {
    LightShadow out;
    out.enabled = light.enabled;
    out.filter = entry(kFilters, light.shadow.filter);
    out.max_error_px = light.shadow.max_error_px;
    out.narrowest_caster_px = light.shadow.narrowest_caster_px;
    out.resolution_px = light.shadow.resolution_px;
    out.cascades = light.shadow.cascades;
    out.layers = light.layers;
    return out;
}

ShadowTuning tuning_of(const Light& light) {
    const Shadow& shadow = light.shadow;
    static_assert(kMostCascades == kMaxCascades);
    ShadowTuning out;
    out.kernel.size_texel = shadow.kernel_texel;
    out.kernel.spread_texel = shadow.spread_texel;
    if (!light_facts(entry(kComponentKinds, light.kind)).parallel) {  // a sun's range starts at an eye of its own
        out.projection.near_m = shadow.near_m;
        out.projection.far_m = shadow.far_m;
    }
    out.cascades.fit = entry(kFits, shadow.fit);
    out.cascades.splits = entry(kSplits, shadow.splits);
    out.cascades.split_lambda = shadow.split_lambda;
    out.cascades.split_m = shadow.split_m;
    out.cascades.blend = shadow.blend;
    out.maps.depth_format = entry(kDepthFormats, shadow.depth_format);
    return out;
}

}  // namespace

void SceneInput::take(const Scene& scene) {
    take_boxes(scene.boxes);
    take_cameras(scene.cameras);
    take_lights(scene.lights);
}

/// Writes the instances and keeps the tree over their bounds: rebuilt for another number of boxes, else refitted to
/// the boxes that moved.
void SceneInput::take_boxes(std::span<const Box> boxes) {
    std::vector<InstanceItem>& items = snapshot_.instances;
    const bool rebuilt = items.size() != boxes.size();
    items.resize(boxes.size());
    snapshot_.changed_instances.clear();
    snapshot_.air.any = false;
    unusable_.boxes = 0;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const Box& box = boxes[i];
        InstanceItem& item = items[i];
        const math::Aabb bounds = bounds_of(box);
        const bool usable = !math::is_empty(bounds);
        if (!usable) ++unusable_.boxes;
        if (!(bounds == item.bounds_ws)) snapshot_.changed_instances.push_back(i);
        item.gpu_slot = i;
        item.bounds_ws = bounds;
        item.mesh = box.air ? kNoMesh : 0;
        snapshot_.air.any |= usable && box.air;
        item.casts = usable && box.casts && !box.air;
        item.receives = usable && box.receives;
        item.visible = usable && box.visible;
        item.cast_layers = box.cast_layers;
        item.receive_layers = box.receive_layers;
    }
    snapshot_.gpu_slot_count = static_cast<std::uint32_t>(boxes.size());
    if (rebuilt)
        build_tree(snapshot_);
    else
        refit_tree(snapshot_);
}

void SceneInput::take_cameras(std::span<const Camera> cameras) {
    snapshot_.consumers.clear();
    cameras_.clear();
    unusable_.cameras = 0;
    for (std::uint32_t i = 0; i < cameras.size(); ++i) {
        const Camera& camera = cameras[i];
        const gnomon::Camera component = component_of(camera);
        if (!usable(component) || !math::is_finite(camera.position_ws_m) || !math::is_finite(camera.rotation_ws) ||
            camera.viewport_px.x == 0 || camera.viewport_px.y == 0) {
            ++unusable_.cameras;
            continue;
        }
        ConsumerItem& item = snapshot_.consumers.emplace_back();
        cameras_.push_back(i);
        item.entity = {i, 0};
        item.projection = component.projection;
        item.viewport_px = camera.viewport_px;
        WorldTransform world;
        world.translation_ws_m = camera.position_ws_m;
        world.basis = camera.rotation_ws;
        place_camera(component, world, item);
        fit_frame(component, item);
        if (item.projection != CameraProjection::orthographic) continue;
        const ViewRange range = flat_range(snapshot_, item, corners_ws_m_);
        item.near_m = range.near_m;
        item.far_m = range.far_m;
    }
}

void SceneInput::take_lights(std::span<const Light> lights) {
    snapshot_.lights.resize(lights.size());
    unusable_lights_.assign(lights.size(), 0);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Light& light = lights[i];
        LightItem& item = snapshot_.lights[i];
        const gnomon::Light component = component_of(light);
        const bool known = static_cast<std::size_t>(light.kind) < std::size(kLightKinds);
        const bool usable = known && gnomon::usable(component) && math::is_finite(light.position_ws_m) &&
                            math::is_finite(light.rotation_ws);
        unusable_lights_[i] = usable ? 0 : 1;
        const Light none;
        const Light& taken = usable ? light : none;
        const gnomon::Light numbers = usable ? component : component_of(none);
        item.entity = {static_cast<std::uint32_t>(light.id), static_cast<std::uint32_t>(light.id >> 32)};
        item.kind = numbers.kind;
        item.position_ws_m = taken.position_ws_m;
        item.rotation_ws = orientation(taken.rotation_ws);
        item.intensity = numbers.intensity;
        item.range_m = static_cast<double>(numbers.range_m);
        item.outer_cone_rad = std::min(static_cast<double>(numbers.outer_cone_rad), glm::half_pi<double>());
        item.source_radius_m = numbers.source_radius_m;
        item.sun_radius_rad = numbers.sun_radius_rad;
        item.has_shadow = usable;
        item.shadow = shadow_of(taken);
        item.tuning = tuning_of(taken);
    }
}

std::uint32_t SceneInput::camera_mask(std::uint32_t consumer_mask) const {
    std::uint32_t mask = 0;
    for (std::uint32_t c = 0; c < cameras_.size(); ++c)
        if ((consumer_mask & shadow::consumer_bit(c)) != 0) mask |= shadow::consumer_bit(cameras_[c]);
    return mask;
}

}  // namespace gnomon::core
