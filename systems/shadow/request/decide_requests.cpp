#include "systems/shadow/request/decide_requests.h"

#include <algorithm>
#include <cmath>

#include "systems/extract/light_facts.h"
#include "systems/shadow/projection/cascade_splits.h"
#include "systems/shadow/projection/depth_range_override.h"
#include "systems/shadow/projection/far_lamp_aim.h"
#include "systems/shadow/projection/spot_cube_transition.h"
#include "systems/shadow/projection/sun_viewpoint.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/filter_choice.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "systems/shadow/request/prefilter_settings.h"
#include "systems/shadow/request/ray_limit.h"

namespace gnomon::shadow {
namespace {

/// Largest automatic edge of a map, texels: 256 MiB for one D32F layer. resolution_px can request more.
constexpr std::uint32_t kLargestAutomatic_px = 8192;
/// Least edge that resolution_px can request, texels. A smaller map has no room for the filter's border.
constexpr std::uint32_t kLeastRequested_px = 16;

/// Edge of a sun's map, texels per pixel of the picture's larger side, at most kUsualSunMap_px. The camera sees edges
/// from nearer and farther than the distance for which the texels are sized. 0.05 % of wrong pixels needs this many
/// (docs/results/cost.md).
constexpr float kSunTexelsPerPixel = 1.6f;
constexpr std::uint32_t kUsualSunMap_px = 2048;

Reason wanted(const LightItem& light, bool shadows) {
    if (!light.has_shadow) return Reason::no_light_shadow;
    if (!shadows || !light.shadow.enabled) return Reason::shadows_off;
    const float brightest = std::max({light.colour.r, light.colour.g, light.colour.b});
    if (!(light.intensity * brightest > 0.0f)) return Reason::light_off;
    return Reason::none;
}

/// Sets a sun's number of cascades and their fade, and notes unusable settings.
void decide_cascades(const LightItem& light, ShadowRequest& request) {
    const ShadowTuning::Cascades& tuning = light.tuning.cascades;
    if (!are_splits(tuning)) request.note = Reason::splits_invalid;
    if (light.shadow.cascades > kMaxCascades) request.note = Reason::cascades_clamped;
    // With rays, further cascades only save rays: one is the default.
    const bool one = light.shadow.cascades == 0 && filter_row(request.map.filter).rays;
    set_cascades(tuning, one ? 1 : cascade_count(light, request.map.view_count), request);
}

/// Returns true if the fit may take fewer cascades. Neither their number nor their splits may be given, and the size of
/// their maps must follow the target.
bool leaves_count(const LightItem& light, const ShadowRequest& request) {
    return light_facts(light.kind).parallel && light.shadow.cascades == 0 && adapts_to_target(light, request) &&
           light.tuning.cascades.splits != CascadeSplits::manual && !request.projection.perspective_sun &&
           request.projection.warp == 0.0f;
}

/// Sets projection and depth range of the light's views. Notes and ignores unusable settings.
void decide_projection(const LightItem& light, ShadowRequest& request) {
    const LightProjection requested = light.tuning.projection.kind;
    const bool sun = light_facts(light.kind).parallel;
    if (sun) decide_cascades(light, request);
    if (is_range(light.tuning.projection)) {
        request.projection.near_m = static_cast<double>(light.tuning.projection.near_m);
        request.projection.far_m = static_cast<double>(light.tuning.projection.far_m);
    } else {
        request.note = Reason::range_invalid;
    }
    if (sun && !is_eye(light.tuning.projection)) {
        request.note = Reason::eye_invalid;
        request.projection.near_m = request.projection.far_m = 0.0;  // they are distances from the eye
    } else if (sun && requested == LightProjection::perspective) {
        request.projection.perspective_sun = true;
        request.map.view_count = 1;
    } else if (!sun && requested == LightProjection::orthographic) {
        request.note = Reason::projection_unsupported;
    }
}

/// Sets the largest warp of a sun's maps. Needs a single camera, because the fit measures a warp's gain for one only.
void decide_warp(const ShadowTuning::Cascades& tuning, bool one_consumer, ShadowRequest& request) {
    if (tuning.warp == 0.0f) return;
    const bool possible = tuning.fit == ShadowFit::tight && one_consumer && !request.projection.perspective_sun &&
                          !needs_distances(request.map.filtering) && request.projection.near_m == 0.0 &&
                          request.projection.far_m == 0.0;
    if (possible && tuning.warp > 0.0f && tuning.warp <= 1.0f)
        request.projection.warp = tuning.warp;
    else
        request.note = Reason::warp_unsupported;
}

/// Replaces a filter with rays by RayRow::without_size for a light without a size: its shadow has no penumbra.
ShadowFilter without_size(const LightItem& light, ShadowFilter filter) {
    const FilterRow& row = filter_row(filter);
    if (!row.rays) return filter;
    const bool has_size = needs_distances(filter_settings(row, light, kLeastMap_px));
    return has_size ? filter : row.rays->without_size;
}

/// Returns the texels of a map's edge per pixel of the picture's larger side. A conservative map costs time to draw and
/// clear each layer, and saves rays. For a cube's six faces half the edge is best. For a sun's map that is drawn once
/// (is_static) twice the edge is best (docs/results/exact.md).
float texels_per_pixel(const LightItem& light, const LightFitHistory* previous, const ShadowRequest& request) {
    constexpr float kOfAFace = 0.5f;
    const FilterRow& row = filter_row(request.map.filter);
    if (!row.rays) return row.texels_per_pixel;
    if (map_texture(light, request) == gl::TextureKind::cube) return row.texels_per_pixel * kOfAFace;
    const bool static_sun = previous && light_facts(light.kind).parallel && is_static(*previous);
    return row.texels_per_pixel * (static_sun ? kStaticSunEdges : 1.0f);
}

/// Returns the target that determines the size of maps. 0 for a filter with rays, which is exact at any size.
float size_target_px(const LightItem& light, const ShadowRequest& request) {
    const ShadowFilter filter = request.map.filter;
    return filter_row(filter).rays ? 0.0f : static_cast<float>(texel_target_px(light.shadow, filter));
}

/// Sets the size of the light's maps: the given size, or a size computed from the picture's. Where the size follows the
/// target, the last frame's smaller size stays (accuracy_target.h).
void decide_resolution(const LightItem& light, glm::uvec2 viewport_px, std::uint32_t limit_px,
                       const LightFitHistory* previous, ShadowRequest& request) {
    const std::uint32_t previous_px = previous ? previous->size.map_px : 0;
    const std::uint32_t requested_px = light.shadow.resolution_px;
    request.limits.max_px = requested_px > 0
                                ? std::clamp(requested_px, std::min(kLeastRequested_px, limit_px), limit_px)
                                : automatic_resolution(viewport_px, texels_per_pixel(light, previous, request),
                                                       size_target_px(light, request), limit_px);
    if (requested_px > 0 && request.limits.max_px != requested_px) request.note = Reason::resolution_clamped;
    set_resolution(light, request.limits.max_px, request);
    if (previous_px > 0 && previous_px < request.limits.max_px && adapts_to_target(light, request))
        set_resolution(light, previous_px, request);
}

/// Returns the largest edge of each map of a sun with a size that follows the target.
std::uint32_t sun_edge_px(const LightItem& light, glm::uvec2 viewport_px, std::uint32_t limit_px,
                          const ShadowRequest& request) {
    const FilterRow& row = filter_row(request.map.filter);
    const std::uint32_t own_px =
        automatic_resolution(viewport_px, row.texels_per_pixel, size_target_px(light, request), limit_px);
    const std::uint32_t usual_px = automatic_resolution(viewport_px, kSunTexelsPerPixel, 1.0f, limit_px);
    return std::max(std::min(usual_px, kUsualSunMap_px), own_px);
}

void decide_cone(const LightItem& light, const LightFitHistory* previous, ShadowRequest& request) {
    request.projection.cube_blend_eighths =
        next_spot_cube_transition(light.outer_cone_rad, previous ? previous->cone : SpotCubeTransition{})
            .cube_blend_eighths;
    request.map.view_count = cone_layers(request.projection.cube_blend_eighths);
}

/// Removes the light's map: rays trace all pixels. Notes on settings of maps are dropped.
void leave_out_map(ShadowRequest& request) {
    request.rays.only = true;
    request.map.view_count = request.limits.max_views = 0;
    request.projection.perspective_sun = false;
    request.note = Reason::none;
}

/// Adapts the request to a conservative map with rays. Rays of a sun are parallel, so that its map cannot have an eye
/// or a warp. Its depths are compared exactly, so that they are floats, and cascades do not fade.
void decide_sheets(ShadowRequest& request) {
    request.rays.used = true;
    if (request.projection.perspective_sun) return leave_out_map(request);
    request.map.depth_format = DepthFormat::d32f;
    request.projection.warp = request.map.cascade_blend = 0.0f;
    if (request.note == Reason::warp_unsupported) request.note = Reason::none;
}

}  // namespace

std::uint32_t automatic_resolution(glm::uvec2 viewport_px, float texels_per_pixel, float max_error_px,
                                   std::uint32_t limit_px) {
    const double finest_px = std::min(max_error_px > 0.0f ? static_cast<double>(max_error_px) : 1.0, 1.0);
    const std::uint32_t most_px = std::min(limit_px, kLargestAutomatic_px);
    const double wanted_px =
        std::ceil(std::max(viewport_px.x, viewport_px.y) * static_cast<double>(texels_per_pixel) / finest_px);
    const auto bounded_px =
        static_cast<std::uint32_t>(std::clamp(wanted_px, double{kLeastMap_px}, double{kLargestAutomatic_px}));
    return std::min((bounded_px + kLeastMap_px - 1) / kLeastMap_px * kLeastMap_px, most_px);
}

void set_cascades(const ShadowTuning::Cascades& tuning, std::uint32_t count, ShadowRequest& request) {
    request.map.view_count = count;
    request.map.cascade_blend = count > 1 ? (are_splits(tuning) ? tuning : ShadowTuning::Cascades{}).blend : 0.0f;
}

void set_resolution(const LightItem& light, std::uint32_t size_px, ShadowRequest& request) {
    request.map.resolution_px = size_px;
    const FilterRow& row = filter_row(request.map.filter);
    request.map.filtering = filter_settings(row, light, size_px);
    request.map.moments = prefilter_settings(row, light, size_px);
    request.map.moments.sampler_anisotropy = map_texture(light, request) != gl::TextureKind::cube;
    if (request.map.filtering.cut || request.map.moments.cut) request.note = Reason::filter_cut;
}

void set_most(const LightItem& light, std::uint32_t most_px, std::uint32_t previous_px, ShadowRequest& request) {
    request.limits.max_px = most_px;
    set_resolution(light, previous_px > 0 ? std::min(previous_px, most_px) : most_px, request);
}

ShadowRequest request_with(const SceneSnapshot& scene, const DeviceMaps& device,
                           const LightFitHistory* previous_of_light, std::uint32_t i, ShadowFilter filter) {
    filter = without_size(scene.lights[i], filter);
    glm::uvec2 viewport_px{1, 1};
    for (const ConsumerItem& consumer : scene.consumers) viewport_px = glm::max(viewport_px, consumer.viewport_px);
    const LightItem& light = scene.lights[i];
    ShadowRequest request;
    request.map.filter = filter;
    request.map.depth_format = light.tuning.maps.depth_format;
    request.map.view_count = light_kind_row(light.kind).layers;
    if (light.tuning.maps.short_references) request.map.references = device.references;
    request.limits.device_px = device.edge_px;
    request.projection.aim = next_far_lamp_aim(scene, light, previous_of_light ? previous_of_light->aim : FarLampAim{});
    decide_resolution(light, viewport_px, device.edge_px, previous_of_light, request);
    decide_projection(light, request);
    if (light_facts(light.kind).parallel) decide_warp(light.tuning.cascades, scene.consumers.size() == 1, request);
    if (light_facts(light.kind).cone) decide_cone(light, previous_of_light, request);
    if (request.projection.aim.used) {
        request.projection.cube_blend_eighths = 0;
        request.map.view_count = 1;
    }
    if (leaves_count(light, request)) {
        request.limits.max_views = request.map.view_count;
        if (previous_of_light && previous_of_light->count.cascades > 0 &&
            previous_of_light->count.cascades < request.limits.max_views)
            set_cascades(light.tuning.cascades, previous_of_light->count.cascades, request);
    }
    if (light_facts(light.kind).parallel && adapts_to_target(light, request))
        set_most(light, sun_edge_px(light, viewport_px, device.edge_px, request),
                 previous_of_light ? previous_of_light->size.map_px : 0, request);
    if (filter_row(request.map.filter).rays) decide_sheets(request);
    return request;
}

bool wants_rays(const SceneSnapshot& scene, const History& previous, bool shadows) {
    std::size_t guess = 0;
    for (const LightItem& light : scene.lights) {
        if (wanted(light, shadows) != Reason::none) continue;
        const LightFitHistory* last = find(previous, light.entity, guess++);
        const ShadowFilter filter = without_size(light, filter_to_fit(light, last ? &last->filter : nullptr));
        if (filter_row(filter).rays) return true;
    }
    return false;
}

void decide_requests(const SceneSnapshot& scene, const RequestInputs& inputs, RayFallbacks& fallbacks,
                     std::vector<ShadowRequest>& requests) {
    requests.clear();
    find_histories(scene.lights, inputs.previous, fallbacks.previous);
    const auto request = [&](std::uint32_t i, ShadowFilter filter) {
        const bool cube = light_kind_row(scene.lights[i].kind).texture == gl::TextureKind::cube;
        const std::uint32_t limit_px = cube ? inputs.device.max_cube_px : inputs.device.max_texture_px;
        return request_with(scene, {limit_px, inputs.references}, fallbacks.previous[i], i, filter);
    };
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const LightItem& light = scene.lights[i];
        const LightFitHistory* last = fallbacks.previous[i];
        requests.push_back(request(i, filter_to_fit(light, last ? &last->filter : nullptr)));
        requests.back().skip = wanted(light, inputs.shadows);
    }
    choose_fallbacks(scene, inputs.rays, requests, fallbacks);
    for (std::uint32_t i = 0; i < requests.size(); ++i) {
        if (fallbacks.reasons[i] == Reason::none) continue;
        const ShadowFilter filter = filter_row(requests[i].map.filter).rays->without_rays;
        requests[i] = request(i, filter);
        requests[i].rays.fell_back = true;
        requests[i].note = fallbacks.reasons[i];
    }
}

}  // namespace gnomon::shadow
