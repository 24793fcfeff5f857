#include "systems/shadow/request/decide_requests.h"

#include <algorithm>
#include <cmath>

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

namespace gnomon::shadow {
namespace {

/// 256 MiB for one D32F layer: who wants more asks for it by resolution_px.
constexpr std::uint32_t kLargestAutomatic_px = 8192;
/// Below this no margin for the filter is left around the content.
constexpr std::uint32_t kLeastRequested_px = 16;

/// Of each of a sun's maps, per pixel of the picture's larger side, and up to which size: its edges are seen from
/// nearer and farther than its texels are made for. 0.05 % of wrong pixels takes so many (docs/cost.md).
constexpr float kSunTexelsPerPixel = 1.6f;
constexpr std::uint32_t kUsualSunMap_px = 2048;

Reason wanted(const LightItem& light, bool shadows) {
    if (!light.has_shadow) return Reason::no_light_shadow;
    if (!shadows || !light.shadow.enabled) return Reason::shadows_off;
    const float brightest = std::max({light.colour.r, light.colour.g, light.colour.b});
    if (!(light.intensity * brightest > 0.0f)) return Reason::light_off;
    return Reason::none;
}

/// How many cascades a sun has, and what fades between them.
void decide_cascades(const LightItem& light, bool depths_failed, ShadowDemand& demand) {
    const ShadowTuning::Cascades& tuning = light.tuning.cascades;
    if (depths_failed && tuning.splits == CascadeSplits::sampled) demand.note = Reason::depths_unread;
    if (!are_splits(tuning)) demand.note = Reason::splits_invalid;
    if (light.shadow.cascades > kMaxCascades) demand.note = Reason::cascades_clamped;
    // A finer map only saves rays: of itself a light asks for one.
    const bool one = light.shadow.cascades == 0 && asks_rays(filter_row(demand.filter));
    set_cascades(tuning, one ? 1 : cascade_count(light, demand.view_count), demand);
}

/// Whether the fit may take fewer cascades: their number is not given, nor are their ends, and their maps are as large
/// as the contract makes them.
bool leaves_count(const LightItem& light, const ShadowDemand& demand) {
    return light.kind == LightKind::directional && light.shadow.cascades == 0 && follows_contract(light, demand) &&
           light.tuning.cascades.splits != CascadeSplits::manual && !demand.perspective_sun && demand.warp == 0.0f;
}

/// Which projection and depth range the light's views have; what cannot be had is noted and left out.
void decide_projection(const LightItem& light, bool depths_failed, ShadowDemand& demand) {
    const LightProjection wish = light.tuning.projection.kind;
    const bool sun = light.kind == LightKind::directional;
    if (sun) decide_cascades(light, depths_failed, demand);
    if (is_range(light.tuning.projection)) {
        demand.near_m = static_cast<double>(light.tuning.projection.near_m);
        demand.far_m = static_cast<double>(light.tuning.projection.far_m);
    } else {
        demand.note = Reason::range_invalid;
    }
    if (sun && !is_eye(light.tuning.projection)) {
        demand.note = Reason::eye_invalid;
        demand.near_m = demand.far_m = 0.0;  // they would be counted from the eye
    } else if (sun && wish == LightProjection::perspective) {
        demand.perspective_sun = true;
        demand.view_count = 1;
    } else if (!sun && wish == LightProjection::orthographic) {
        demand.note = Reason::projection_unsupported;
    }
}

/// How far a sun's maps may be warped. The fit measures what a warp gains for one camera alone.
void decide_warp(const ShadowTuning::Cascades& tuning, bool one_consumer, ShadowDemand& demand) {
    if (tuning.warp == 0.0f) return;
    const bool possible = tuning.fit == ShadowFit::tight && one_consumer && !demand.perspective_sun &&
                          !needs_distances(demand.filtering) && demand.near_m == 0.0 && demand.far_m == 0.0;
    if (possible && tuning.warp > 0.0f && tuning.warp <= 1.0f)
        demand.warp = tuning.warp;
    else
        demand.note = Reason::warp_unsupported;
}

/// Of a point there is nothing to ask but whether it is seen.
ShadowFilter without_size(const LightItem& light, ShadowFilter filter) {
    if (filter != ShadowFilter::exact_soft) return filter;
    const bool has_size = needs_distances(filter_demand(filter_row(filter), light, kLeastMap_px));
    return has_size ? filter : ShadowFilter::exact;
}

/// A map of sheets costs as it is drawn and cleared, layer by layer, and saves rays: a cube's six are worth half the
/// edge (docs/exact.md, "What it costs"), a sun's that is drawn once and for all (is_quiet) twice.
float texels_per_pixel(const LightItem& light, const HeldLight* held, const ShadowDemand& demand) {
    constexpr float kOfAFace = 0.5f;
    const FilterRow& row = filter_row(demand.filter);
    if (!asks_rays(row)) return row.texels_per_pixel;
    if (map_texture(light, demand) == gl::TextureKind::cube) return row.texels_per_pixel * kOfAFace;
    const bool waits = held && light.kind == LightKind::directional && is_quiet(*held);
    return row.texels_per_pixel * (waits ? kQuietEdges : 1.0f);
}

/// What errs by nothing is no larger for a smaller error.
float wished_resolution_px(const LightItem& light, const ShadowDemand& demand) {
    return asks_rays(filter_row(demand.filter)) ? 0.0f : light.shadow.max_error_px;
}

/// As large as the picture asks for, or as the fits found to be enough (accuracy_target.h).
void decide_resolution(const LightItem& light, glm::uvec2 viewport_px, std::uint32_t limit_px, const HeldLight* held,
                       ShadowDemand& demand) {
    const std::uint32_t held_px = held ? held->map_px : 0;
    const std::uint32_t asked_px = light.shadow.resolution_px;
    demand.most_px = asked_px > 0 ? std::clamp(asked_px, std::min(kLeastRequested_px, limit_px), limit_px)
                                  : automatic_resolution(viewport_px, texels_per_pixel(light, held, demand),
                                                         wished_resolution_px(light, demand), limit_px);
    if (asked_px > 0 && demand.most_px != asked_px) demand.note = Reason::resolution_clamped;
    set_resolution(light, demand.most_px, demand);
    if (held_px > 0 && held_px < demand.most_px && follows_contract(light, demand))
        set_resolution(light, held_px, demand);
}

/// Most edge of each map of a sun that follows the contract.
std::uint32_t sun_edge_px(const LightItem& light, glm::uvec2 viewport_px, std::uint32_t limit_px,
                          const ShadowDemand& demand) {
    const FilterRow& row = filter_row(demand.filter);
    const std::uint32_t own_px =
        automatic_resolution(viewport_px, row.texels_per_pixel, light.shadow.max_error_px, limit_px);
    const std::uint32_t usual_px = automatic_resolution(viewport_px, kSunTexelsPerPixel, 1.0f, limit_px);
    return std::max(std::min(usual_px, kUsualSunMap_px), own_px);
}

void decide_cone(const LightItem& light, const HeldLight* held, ShadowDemand& demand) {
    demand.faces_eighths = next_cone_fade(light.outer_cone_rad, held ? held->cone : ConeFade{}).faces_eighths;
    demand.view_count = cone_layers(demand.faces_eighths);
}

/// Nothing that is said of maps is of any account.
void leave_out_map(ShadowDemand& demand) {
    demand.traced = true;
    demand.view_count = demand.most_views = 0;
    demand.perspective_sun = false;
    demand.note = Reason::none;
}

/// Rays follow the sun, and what its maps are certain of has to as well: no eye, no warp. What they store is compared
/// to the last digit, and drawn from all sides; whatever else is said of them is of no account.
void decide_sheets(ShadowDemand& demand) {
    demand.asks_rays = true;
    if (demand.perspective_sun) return leave_out_map(demand);
    demand.depth_format = DepthFormat::d32f;
    demand.warp = demand.cascade_blend = 0.0f;
    if (demand.note == Reason::warp_unsupported) demand.note = Reason::none;
}

}  // namespace

std::uint32_t automatic_resolution(glm::uvec2 viewport_px, float texels_per_pixel, float max_error_px,
                                   std::uint32_t limit_px) {
    const double finest_px = std::min(max_error_px > 0.0f ? static_cast<double>(max_error_px) : 1.0, 1.0);
    const std::uint32_t most_px = std::min(limit_px, kLargestAutomatic_px);
    const double wish_px =
        std::ceil(std::max(viewport_px.x, viewport_px.y) * static_cast<double>(texels_per_pixel) / finest_px);
    const auto bounded_px =
        static_cast<std::uint32_t>(std::clamp(wish_px, double{kLeastMap_px}, double{kLargestAutomatic_px}));
    return std::min((bounded_px + kLeastMap_px - 1) / kLeastMap_px * kLeastMap_px, most_px);
}

void set_cascades(const ShadowTuning::Cascades& tuning, std::uint32_t count, ShadowDemand& demand) {
    demand.view_count = count;
    demand.cascade_blend = count > 1 ? (are_splits(tuning) ? tuning : ShadowTuning::Cascades{}).blend : 0.0f;
}

void set_resolution(const LightItem& light, std::uint32_t size_px, ShadowDemand& demand) {
    demand.resolution_px = size_px;
    const FilterRow& row = filter_row(demand.filter);
    demand.filtering = filter_demand(row, light, size_px);
    demand.moments = moment_demand(row, light, size_px);
    demand.moments.sampler_anisotropy = map_texture(light, demand) != gl::TextureKind::cube;
    if (demand.filtering.cut || demand.moments.cut) demand.note = Reason::filter_cut;
}

void set_most(const LightItem& light, std::uint32_t most_px, std::uint32_t held_px, ShadowDemand& demand) {
    demand.most_px = most_px;
    set_resolution(light, held_px > 0 ? std::min(held_px, most_px) : most_px, demand);
}

ShadowDemand demand_of(const SceneSnapshot& scene, const gl::DeviceInfo& device, const History& held, std::uint32_t i,
                       ShadowFilter filter) {
    const LightItem& light = scene.lights[i];
    const bool cube = light_kind_row(light.kind).texture == gl::TextureKind::cube;
    return demand_with(scene, cube ? device.max_cube_px : device.max_texture_px, find(held, light.entity, i), i,
                       filter);
}

ShadowDemand demand_with(const SceneSnapshot& scene, std::uint32_t limit_px, const HeldLight* held_light,
                         std::uint32_t i, ShadowFilter filter) {
    filter = without_size(scene.lights[i], filter);
    glm::uvec2 viewport_px{1, 1};
    for (const ConsumerItem& consumer : scene.consumers) viewport_px = glm::max(viewport_px, consumer.viewport_px);
    const LightItem& light = scene.lights[i];
    ShadowDemand demand;
    demand.light = i;
    demand.filter = filter;
    demand.depth_format = light.tuning.maps.depth_format;
    demand.view_count = light_kind_row(light.kind).layers;
    demand.device_px = limit_px;
    demand.aim = next_lamp_aim(scene, light, held_light ? held_light->aim : LampAim{});
    decide_resolution(light, viewport_px, limit_px, held_light, demand);
    decide_projection(light, scene.sampled_depths.failed, demand);
    if (light.kind == LightKind::directional) decide_warp(light.tuning.cascades, scene.consumers.size() == 1, demand);
    if (light.kind == LightKind::spot) decide_cone(light, held_light, demand);
    if (demand.aim.used) {
        demand.faces_eighths = 0;
        demand.view_count = 1;
    }
    if (leaves_count(light, demand)) {
        demand.most_views = demand.view_count;
        if (held_light && held_light->cascades > 0 && held_light->cascades < demand.most_views)
            set_cascades(light.tuning.cascades, held_light->cascades, demand);
    }
    if (light.kind == LightKind::directional && follows_contract(light, demand))
        set_most(light, sun_edge_px(light, viewport_px, limit_px, demand), held_light ? held_light->map_px : 0, demand);
    if (asks_rays(filter_row(demand.filter))) decide_sheets(demand);
    return demand;
}

void decide_demand(const SceneSnapshot& scene, const gl::DeviceInfo& device, bool shadows, const History& held,
                   std::vector<ShadowDemand>& demands) {
    demands.clear();
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const LightItem& light = scene.lights[i];
        const HeldLight* last = find(held, light.entity, i);
        demands.push_back(demand_of(scene, device, held, i, filter_to_fit(light, last ? &last->filter : nullptr)));
        demands.back().skip = wanted(scene.lights[i], shadows);
    }
}

}  // namespace gnomon::shadow
