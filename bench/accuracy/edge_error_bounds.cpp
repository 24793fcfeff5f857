#include "bench/accuracy/edge_error_bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "bench/glsl_on_cpu/cpu_lookup.h"
#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/limited_request.h"
#include "tests/oracle/fit_stages.h"

namespace gnomon::bench {
namespace {

using shadow::ShadowView;

/// A cascade's lookup may lie this far from the point, beside the filter's reach: it is moved along the normal.
constexpr double kMovedTexel = 1.0;

/// A hard shadow's edge is where it is half lit.
constexpr double kHalf = 0.5;

bool orthographic(const ShadowView& view) { return view.projection == shadow::ViewProjection::orthographic; }

/// Returns where the point lies in the map of a cascade: u, v, depth, each 0 to 1 if inside.
glm::dvec3 in_map(const ShadowView& view, const glm::dvec3& p_ws) {
    const glm::dvec4 q = glm::dmat4(view.map_from_anchor) * glm::dvec4(p_ws - view.pose.anchor_ws_m, 1.0);
    return q.w > 0.0 ? glm::dvec3(q) / q.w : glm::dvec3(-1.0);
}

bool holds(const glm::dvec3& at, double margin) {
    return at.x >= margin && at.y >= margin && at.x <= 1.0 - margin && at.y <= 1.0 - margin && at.z >= 0.0 &&
           at.z <= 1.0;
}

/// Returns how far a point in a cascade's map has faded out of it, 0 to 1. A map also serves what lies beyond its
/// slice, up to its border, unless it serves by distance.
double faded(const ShadowView& view, const glm::dvec3& at, double distance_m, double margin, double blend) {
    if (!(blend > 0.0)) return 0.0;
    const double share = faded_by_distance(view.cascade.fades_from_m, view.cascade.fades_to_m, distance_m);
    if (view.cascade.seen_to_m > 0.0) return share;
    const glm::dvec3 inside = glm::min(at, 1.0 - at);
    return std::min(share, faded_near_border(std::min({inside.x - margin, inside.y - margin, inside.z}), blend));
}

double depth_from(const ShadowView& view, const glm::dvec3& p_ws) {
    return glm::dot(apex_ws_m(view) - p_ws, view.pose.axis_back);
}

/// Returns the unit vector toward the light.
glm::dvec3 to_light(const ShadowView& view, const glm::dvec3& p_ws) {
    return orthographic(view) ? view.pose.axis_back : glm::normalize(apex_ws_m(view) - p_ws);
}

/// Returns the bound for a lit point: no texel, and only the picture's own pixels as error.
oracle::TexelThere lit() {
    oracle::TexelThere texel;
    texel.error_px = shadow::edge_error_px(0.0, 0.0);
    return texel;
}

/// Returns how many texels aside the offset along the normal moves a lookup
/// (shaders/shadow/lookup/bias/automatic.glsl).
double moved_texel(const ShadowView& view, const shadow::ShadowRequest& demand, const shadow::TexelSides& sides,
                   const glm::dvec3& p_ws, const glm::dvec3& normal, double filter_texel) {
    const double along_m =
        filter_texel * (std::abs(glm::dot(normal, sides.u_m)) + std::abs(glm::dot(normal, sides.v_m)));
    const glm::dvec3 moved = glm::abs(in_map(view, p_ws + normal * along_m) - in_map(view, p_ws));
    return std::max(moved.x, moved.y) * demand.map.resolution_px;
}

/// Returns the texel around the point, under a filter of that half-width, without an error.
oracle::TexelThere texel_there(const ShadowView& view, const shadow::ShadowRequest& demand, const glm::dvec3& p_ws,
                               const glm::dvec3& normal, double filter_texel) {
    const shadow::TexelSides sides = shadow::texel_sides(view, p_ws);
    oracle::TexelThere texel{
        .u_m = sides.u_m, .v_m = sides.v_m, .filter_texel = filter_texel, .reach_texel = filter_texel};
    texel.depth_m = shadow::min_resolvable_gap_m(view, demand.map.depth_format, p_ws);
    const double cosine = glm::dot(to_light(view, p_ws), normal);
    if (std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) > steep_tangent() * cosine) {
        texel.reach_texel += moved_texel(view, demand, sides, p_ws, normal, filter_texel);
    }
    return texel;
}

}  // namespace

EdgeBounds::EdgeBounds(const SceneSnapshot& scene, const gl::DeviceInfo& device, const shadow::History& held)
    : scene_(scene) {
    shadow::FitStages stages;
    stages.decide(scene, device, held);
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const LightItem& light = scene.lights[i];
        const shadow::LightFitHistory* last = find(held, light.entity, i);
        shadow::ShadowRequest& request = stages.frame.requests[i];
        if (last && !(last->budget.grant == shadow::QualityLimits{}))
            request = shadow::granted(light, request, last->budget.grant);
    }
    stages.select(scene);
    stages.fit(scene, held);
    fitted_ = std::move(stages.frame.fitted);
}

double EdgeBounds::reach_texel(const ShadowView& view) const {
    return static_cast<double>(fitted_.lights[view.light].request.map.filtering.widest_texel);
}

double EdgeBounds::edge_texel(const ShadowView& view) const {
    const shadow::FilterSettings& filter = fitted_.lights[view.light].request.map.filtering;
    return static_cast<double>(filter.widest_texel - filter.still_texel);
}

/// Chooses as the shaders do. Near the border of a cascade's map the next, coarser one may serve. It is taken there,
/// and where most of the light has faded into it.
const ShadowView* EdgeBounds::view_of(std::uint32_t light, const glm::dvec3& point_ws_m) const {
    const ConsumerItem& consumer = scene_.consumers.front();
    const double distance_m = -glm::dot(point_ws_m - consumer.position_ws_m, consumer.rotation_ws[2]);
    const ShadowView* best = nullptr;
    const ShadowView* nearer = nullptr;
    const shadow::MapSettings& map = fitted_.lights[light].request.map;
    for (const ShadowView& view : fitted_.views_of(light)) {
        if (orthographic(view)) {
            const bool passed = view.cascade.seen_to_m > 0.0 && distance_m > view.cascade.seen_to_m;
            const double margin = (reach_texel(view) + kMovedTexel) / map.resolution_px;
            const glm::dvec3 at = in_map(view, point_ws_m);
            if (passed || !holds(at, margin)) continue;
            const bool decides =
                nearer || faded(view, at, distance_m, margin, static_cast<double>(map.cascade_blend)) < kHalf;
            if (decides) return &view;
            nearer = &view;
            continue;
        }
        if (!best || depth_from(view, point_ws_m) > depth_from(*best, point_ws_m)) best = &view;
    }
    if (nearer) return nearer;  // with nothing to fade into
    return best && depth_from(*best, point_ws_m) > 0.0 ? best : nullptr;
}

oracle::TexelThere EdgeBounds::at(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal,
                                  double telling) const {
    const ConsumerItem& consumer = scene_.consumers.front();
    const glm::dvec3 p_ws = consumer.position_ws_m + point_rel_m;
    const ShadowView* view = view_of(light, p_ws);
    if (!view) return lit();
    oracle::TexelThere texel =
        texel_there(*view, fitted_.lights[view->light].request, p_ws, normal, reach_texel(*view));
    texel.u_m *= telling;
    texel.v_m *= telling;
    texel.error_px =
        shadow::edge_error_px(shadow::texel_extent_px(*view, consumer, p_ws, normal) * telling, texel.filter_texel);
    return texel;
}

oracle::TexelThere EdgeBounds::of_target(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal,
                                         double target_factor) const {
    return within(light, point_rel_m, normal, shadow::target_error_px(scene_.lights[light].shadow), target_factor);
}

oracle::TexelThere EdgeBounds::within(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal,
                                      double error_px, double target_factor) const {
    const glm::dvec3 p_ws = scene_.consumers.front().position_ws_m + point_rel_m;
    const ShadowView* view = view_of(light, p_ws);
    if (!view) return lit();
    oracle::TexelThere texel = texel_there(*view, fitted_.lights[view->light].request, p_ws, normal, edge_texel(*view));
    texel.u_m *= target_factor;
    texel.v_m *= target_factor;
    texel.error_px = shadow::allowed_error_px(target_factor * error_px, glm::dot(to_light(*view, p_ws), normal));
    return texel;
}

double EdgeBounds::resolved_m(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal) const {
    const oracle::TexelThere texel = resolving(light, point_rel_m, normal);
    const double diagonal_m = std::max(glm::length(texel.u_m + texel.v_m), glm::length(texel.u_m - texel.v_m));
    return shadow::resolved_width_texel(texel.filter_texel) * diagonal_m;
}

double EdgeBounds::stated_px(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal) const {
    const glm::dvec3 p_ws = scene_.consumers.front().position_ws_m + point_rel_m;
    const ShadowView* view = view_of(light, p_ws);
    if (!view) return 0.0;
    return shadow::stated_error_px(*view, glm::dot(to_light(*view, p_ws), normal), reach_texel(*view));
}

}  // namespace gnomon::bench
