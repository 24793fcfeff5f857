#include "systems/shadow/fitting/error_bound.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "systems/extract/volumes.h"
#include "systems/shadow/frame/depth_format.h"
#include "systems/shadow/projection/lispsm_math.h"
#include "systems/shadow/request/accuracy_target.h"

namespace gnomon::shadow {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Points on the border of a view count as inside. Share of its sides.
constexpr double kSlack = 1.0 / (1 << 20);
/// Error of a position that is rebuilt from depth, as a share of its distance (shaders/common/position_error.glsl).
constexpr double kPosition = 1.6e-7;

bool is_perspective(const ConsumerItem& consumer) { return consumer.projection == CameraProjection::perspective; }

double depth_from(const ConsumerItem& consumer, const glm::dvec3& p_ws) {
    return glm::dot(consumer.position_ws_m - p_ws, consumer.rotation_ws[2]);
}

double depth_from_light(const ShadowView& view, const glm::dvec3& p_ws) {
    return glm::dot(apex_ws_m(view) - p_ws, view.pose.axis_back);
}

/// Returns the displacement on screen of a small displacement at p, pixels.
glm::dvec2 on_screen(const ConsumerItem& consumer, const glm::dvec3& p_ws, const glm::dvec3& displacement_m) {
    const double footprint = pixel_footprint(consumer);
    const glm::dvec3 d = displacement_m * consumer.rotation_ws;
    if (!is_perspective(consumer)) return glm::dvec2(d) / footprint;
    const glm::dvec3 p = (p_ws - consumer.position_ws_m) * consumer.rotation_ws;
    const double z_m = -p.z;
    return (glm::dvec2(d) + glm::dvec2(p) * (d.z / z_m)) / (z_m * footprint);
}

/// Most pixels that a metre covers at a depth, anywhere on a camera's screen and in any direction.
class PixelsPerMetre {
public:
    explicit PixelsPerMetre(const ConsumerItem& consumer)
        : perspective_(is_perspective(consumer)), footprint_(pixel_footprint(consumer)) {
        if (perspective_) slant_ = std::sqrt(squared_corner_slant(consumer));
    }
    double at(double depth_m) const { return perspective_ ? slant_ / (depth_m * footprint_) : 1.0 / footprint_; }

private:
    bool perspective_;
    double footprint_, slant_ = 1.0;
};

glm::dvec2 across(const ShadowView& view, const glm::dvec3& p_ws) {
    const glm::dvec3 p = p_ws - apex_ws_m(view);
    return {glm::dot(p, view.pose.axis_u), glm::dot(p, view.pose.axis_v)};
}

/// Returns the diagonal of a texel across the light at a point inside the view, metres. In a warped map it is a bound
/// for all places between such points.
double texel_at(const ShadowView& view, const glm::dvec3& p_ws) {
    const glm::dvec2 texel(view.plane.texel_u, view.plane.texel_v);
    if (!is_parallel(view)) return glm::length(texel) * depth_from_light(view, p_ws);
    const double steepness = glm::length(view.plane.warp);
    if (!(steepness > 0.0)) return glm::length(texel);
    const glm::dvec2 aside(-view.plane.warp.y / steepness, view.plane.warp.x / steepness);
    const double farthest_aside =
        std::abs(glm::dot(aside, view.plane.centre_ls_m)) + glm::dot(glm::abs(aside), view.plane.half_extent_m);
    return longest_cell(view.plane.warp, texel, farthest_aside, warp_w(view.plane.warp, across(view, p_ws)));
}

bool within(const ShadowView& view, const glm::dvec3& p_ws) {
    if (is_parallel(view)) return true;
    const glm::dvec3 p = p_ws - apex_ws_m(view);
    const double z_m = depth_from_light(view, p_ws);
    const glm::dvec2 at(glm::dot(p, view.pose.axis_u), glm::dot(p, view.pose.axis_v));
    const glm::dvec2 slack = kSlack * (view.plane.tan_high - view.plane.tan_low);
    return z_m > 0.0 && glm::all(glm::greaterThanEqual(at, (view.plane.tan_low - slack) * z_m)) &&
           glm::all(glm::lessThanEqual(at, (view.plane.tan_high + slack) * z_m));
}

/// Calls `visit` for each point that is in front of the camera and in the view. It gets a texel's diagonal
/// there, metres, and the distance from which the view serves it. Then come the pixels of a metre on the steepest
/// receiver, and the point's distance along the view.
template <class Visit>
void for_each_served(const ShadowView& view, const ConsumerItem& consumer, std::span<const glm::dvec3> points_ws,
                     const Visit& visit) {
    const PixelsPerMetre pixels_per_metre(consumer);
    for (const glm::dvec3& p_ws : points_ws) {
        const double depth_m = depth_from(consumer, p_ws);
        if (!(depth_m > 0.0) || !within(view, p_ws)) continue;
        const double served_m = std::max({depth_m, consumer.near_m, view.cascade.seen_from_m});
        visit(texel_at(view, p_ws), served_m, kSteepestReceiver * pixels_per_metre.at(served_m), depth_m);
    }
}

/// Computes the bound over all receivers of a view, as state_error(). All 0 if nothing is in front of the camera.
ViewError predict_error(const ShadowView& view, const ConsumerItem& consumer, std::span<const glm::dvec3> points_ws,
                        double reach_texel) {
    ViewError error;
    // Texel over pixel is a ratio of two linear functions of the point: largest at a corner.
    for_each_served(view, consumer, points_ws, [&](double texel_m, double served_m, double metre_px, double) {
        error.texel_m = std::max(error.texel_m, texel_m);
        error.extent_px = std::max(error.extent_px, texel_m * metre_px);
        error.metre_px = std::max(error.metre_px, metre_px);
        error.rounding_px = std::max(error.rounding_px, kPosition * served_m * metre_px);
    });
    if (error.texel_m > 0.0) error.texel_edge_px = edge_error_px(error.extent_px, reach_texel);
    error.resolved_m = resolved_width_texel(reach_texel) * error.texel_m;
    return error;
}

}  // namespace

void add_extents(const ConsumerItem& consumer, std::span<const glm::dvec3> points_ws, const ShadowView& view,
                 ExtentSum& sum) {
    for_each_served(view, consumer, points_ws, [&](double texel_m, double, double metre_px, double depth_m) {
        const double to_m = view.cascade.seen_to_m;
        if (depth_m < view.cascade.seen_from_m || (to_m > 0.0 && depth_m > to_m)) return;
        const double extent_px = texel_m * metre_px;
        if (!(extent_px > 0.0) || !std::isfinite(extent_px)) return;
        sum.log2_px += std::log2(extent_px);
        ++sum.points;
    });
}

TexelSides texel_sides(const ShadowView& view, const glm::dvec3& p_ws) {
    const auto side = [&](const glm::dvec2& texel) {
        const glm::dvec2 step = is_parallel(view) ? unwarped_step(view.plane.warp, across(view, p_ws), texel)
                                                  : texel * depth_from_light(view, p_ws);
        return view.pose.axis_u * step.x + view.pose.axis_v * step.y;
    };
    return {side({view.plane.texel_u, 0.0}), side({0.0, view.plane.texel_v})};
}

double min_resolvable_gap_m(const ShadowView& view, DepthFormat format, const glm::dvec3& p_ws) {
    constexpr double kSteps = 2.0;
    const double depth = kSteps * depth_format_row(format).step;
    if (is_parallel(view)) return depth * (view.depth.far_m - view.depth.near_m);
    // alpha + beta / z: z becomes z / (1 + part), by the same share of the whole distance as the ray.
    const double part = depth * depth_from_light(view, p_ws) / std::abs(view.depth.beta);
    return glm::length(p_ws - apex_ws_m(view)) * part / (1.0 + part);
}

double texel_extent_px(const ShadowView& view, const ConsumerItem& consumer, const glm::dvec3& p_ws,
                       const glm::dvec3& normal) {
    const double z_m = is_parallel(view) ? 1.0 : depth_from_light(view, p_ws);
    const glm::dvec3 ray = is_parallel(view) ? -view.pose.axis_back : (p_ws - apex_ws_m(view)) / z_m;
    const double facing = glm::dot(ray, normal);
    if (!(z_m > 0.0) || facing == 0.0 || (is_perspective(consumer) && !(depth_from(consumer, p_ws) > 0.0)))
        return kInfinity;
    const auto extent = [&](const glm::dvec3& across_m) {
        return glm::length(on_screen(consumer, p_ws, across_m - ray * (glm::dot(across_m, normal) / facing)));
    };
    const TexelSides sides = texel_sides(view, p_ws);
    return std::max(extent(sides.u_m + sides.v_m), extent(sides.u_m - sides.v_m));
}

double stated_error_px(const ShadowView& view, double cosine, double reach_texel) {
    return edge_error_px(view.error.extent_px * slope_factor(cosine), reach_texel);
}

MapAccuracy accuracy_of(const ShadowView& view) {
    const ViewError& error = view.error;
    if (!(error.texel_edge_px > 0.0)) return {};
    return {error.edge_px, error.grid_px, resolved_px(error.texel_edge_px)};
}

void state_edges(bool walks, ShadowView& view) {
    ViewError& error = view.error;
    error.grid_px = walks ? 0.0 : std::min(edge_error_px(0.0, 0.0), error.texel_edge_px);
    error.edge_px = walks && error.texel_edge_px > 0.0 ? walk_error_px(error.rounding_px) : error.texel_edge_px;
}

void state_error(const ConsumerItem& consumer, std::span<const glm::dvec3> points_ws, double reach_texel,
                 ShadowView& view) {
    const ViewError error = predict_error(view, consumer, points_ws, reach_texel);
    view.error.texel_m = std::max(view.error.texel_m, error.texel_m);
    view.error.extent_px = std::max(view.error.extent_px, error.extent_px);
    view.error.texel_edge_px = std::max(view.error.texel_edge_px, error.texel_edge_px);
    view.error.resolved_m = std::max(view.error.resolved_m, error.resolved_m);
    view.error.rounding_px = std::max(view.error.rounding_px, error.rounding_px);
    view.error.metre_px = std::max(view.error.metre_px, error.metre_px);
}

}  // namespace gnomon::shadow
