#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/math/frustum.h"
#include "engine/math/projection.h"
#include "systems/shadow/kinds/rectangle.h"
#include "systems/shadow/light_kinds.h"

/// Directional light: one orthographic view, the smallest rotated rectangle around the visible receivers as the
/// light sees them. Depth runs from the receiver nearest the light to the farthest; casters nearer still are
/// flattened onto the near plane by depth clamping and cast all the same.
namespace gnomon::shadow {
namespace {

/// A flat set of receivers gets at least this share of the largest extent, so that nothing divides by zero.
constexpr double kLeastExtent = 1.0 / (1 << 20);
/// Receivers at the ends of the depth range stay clear of the clamp by this share of the range.
constexpr double kDepthSlack = 1.0 / (1 << 10);

/// A lattice point near `centre_ws`, the same for all fits of about this size: fixed to the world while cameras move.
glm::dvec3 lattice_anchor(const glm::dvec3& centre_ws, double extent_m) {
    const double cell_m = std::exp2(std::ceil(std::log2(extent_m)) + 2.0);
    return glm::round(centre_ws / cell_m) * cell_m;
}

struct DepthRange {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;  // along back, from the world's origin
};

}  // namespace

bool fit_directional(const FitInput& input, std::vector<ShadowView>& views) {
    const glm::dmat3 basis = math::basis_from_back(input.light.rotation_ws[2]);
    // Local storage: the hull of a few hundred points at most, once per sun and frame.
    std::vector<glm::dvec2> points, hull;
    points.reserve(input.receiver_points_ws.size());
    DepthRange depth;
    const glm::dvec3 origin_ws = input.receiver_points_ws.front();
    for (const glm::dvec3& p_ws : input.receiver_points_ws) {
        const glm::dvec3 p = (p_ws - origin_ws) * basis;
        points.emplace_back(p.x, p.y);
        depth.lowest = std::min(depth.lowest, p.z);
        depth.highest = std::max(depth.highest, p.z);
    }
    const Rectangle rectangle = smallest_rectangle(points, hull);
    const glm::dvec2 extent = rectangle.max - rectangle.min;
    const double largest = std::max({extent.x, extent.y, depth.highest - depth.lowest});
    if (!(largest > 0.0) || !std::isfinite(largest)) return false;

    ShadowView view;
    view.projection = ViewProjection::orthographic;
    view.axis_u = basis[0] * rectangle.axis_u.x + basis[1] * rectangle.axis_u.y;
    view.axis_v = basis[1] * rectangle.axis_u.x - basis[0] * rectangle.axis_u.y;
    view.axis_back = basis[2];

    const double size_px = input.demand.resolution_px;
    const double margin_px = std::ceil(static_cast<double>(input.reach_texel)) + 1.0;  // filter footprint, and snapping
    const glm::dvec2 padded = glm::max(extent, glm::dvec2(largest * kLeastExtent)) * (size_px / (size_px - 2.0 * margin_px));
    view.texel_u = padded.x / size_px;
    view.texel_v = padded.y / size_px;
    const double range_m = std::max(depth.highest - depth.lowest, largest * kLeastExtent);
    const double slack_m = range_m * kDepthSlack;

    const glm::dvec2 middle = 0.5 * (rectangle.min + rectangle.max);
    const glm::dvec3 centre_ws = origin_ws + view.axis_u * middle.x + view.axis_v * middle.y +
                                 view.axis_back * (0.5 * (depth.lowest + depth.highest));
    view.anchor_ws_m = lattice_anchor(centre_ws, largest);
    const glm::dvec3 offset = centre_ws - view.anchor_ws_m;
    const glm::dvec3 c(glm::dot(offset, view.axis_u), glm::dot(offset, view.axis_v), glm::dot(offset, view.axis_back));
    view.near_m = -c.z - 0.5 * range_m - slack_m;
    view.far_m = -c.z + 0.5 * range_m + slack_m;

    const glm::dmat4 view_from_anchor(glm::transpose(glm::dmat3(view.axis_u, view.axis_v, view.axis_back)));
    const glm::dmat4 clip_from_anchor =
        math::reversed_orthographic(c.x - 0.5 * padded.x, c.x + 0.5 * padded.x, c.y - 0.5 * padded.y, c.y + 0.5 * padded.y,
                                    view.near_m, view.far_m) * view_from_anchor;
    view.clip_from_anchor = glm::mat4(clip_from_anchor);
    view.map_from_anchor = glm::mat4(math::texture_from_clip() * clip_from_anchor);
    views.push_back(view);
    return true;
}

}  // namespace gnomon::shadow
