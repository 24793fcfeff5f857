#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "gnomon/core.h"

namespace gnomon::core {
namespace {

// The numbers of shaders/shadow/lookup/bias/automatic.glsl and shaders/common/float_rounding.glsl.
constexpr double kSteepTangent = 4.0, kMostGrowth = 0.5, kPositionRounding = 12.0 * 0x1p-24;

double sum_of(const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// Returns the normal's components along the map's axes.
glm::dvec3 in_map(const View& view, const glm::dvec3& v) {
    return {glm::dot(v, view.axis_u), glm::dot(v, view.axis_v), glm::dot(v, view.axis_back)};
}

Offset orthographic_offset(const View& view, const glm::dvec3& n_map, double error_m, double normal_error_rad) {
    const glm::dvec2 lateral = glm::abs(glm::dvec2(n_map)) + normal_error_rad;
    const double across_m = view.bias.reach_texel * glm::dot(lateral, view.bias.texel) + error_m;
    const double cosine = n_map.z - normal_error_rad;
    const bool steep = !(glm::length(lateral) <= kSteepTangent * cosine);
    if (steep) return {across_m, view.bias.depth};
    return {0.0, view.bias.depth + across_m / (cosine * (view.far_m - view.near_m))};
}

/// What a footprint sees of a receiver's plane from a lamp.
struct Tangents {
    glm::dvec2 of_plane{0.0};  // bound on |n_u| and |n_v|
    double leaving = 0.0;      // how much farther along the axis a metre along the normal leads
};

/// Counts all three components of the normal near the seam of a cube's face: texels of its neighbour take part there.
Tangents tangents_of(const View& view, const glm::dvec3& n_map, const glm::dvec3& p_map) {
    Tangents t{glm::abs(glm::dvec2(n_map)), std::max(-n_map.z, 0.0)};
    if (view.kind != ViewKind::cube_face) return t;
    const double z_m = -p_map.z, second_m = std::max(std::abs(p_map.x), std::abs(p_map.y));
    const double beyond = (view.bias.reach_texel + 1.0) * view.bias.texel.x;
    if (!(second_m > z_m * (1.0 - 2.0 * beyond))) return t;
    t.leaving = std::max({t.leaving, t.of_plane.x, t.of_plane.y});
    t.of_plane = (t.of_plane + std::abs(n_map.z)) * (1.0 + beyond);
    return t;
}

Offset perspective_offset(const View& view, const glm::dvec3& n_map, const glm::dvec3& p_map, double error_m,
                          double normal_error_rad) {
    const double z_m = -p_map.z, distance_m = glm::length(p_map);
    const Tangents tangents = tangents_of(view, n_map, p_map);
    const double spread = view.bias.reach_texel * glm::dot(tangents.of_plane + normal_error_rad, view.bias.texel);
    const double across_m = spread * z_m + error_m;
    const double plane_m = -glm::dot(n_map, p_map) - normal_error_rad * distance_m - error_m;
    const double aside_m = std::sqrt(std::max(distance_m * distance_m - plane_m * plane_m, 0.0));
    const bool steep = !(aside_m <= kSteepTangent * plane_m);
    const double range_m = view.far_m - view.near_m;
    const double alpha = -view.near_m / range_m, beta = view.near_m * view.far_m / range_m;
    const double rounding = view.bias.depth + view.bias.depth_share * (alpha + beta / z_m);
    if (steep) return {across_m / (1.0 - std::min(spread * tangents.leaving, kMostGrowth)), rounding};
    return {0.0, rounding + beta * across_m / (z_m * plane_m)};
}

}  // namespace

glm::dvec3 map_place(const View& view, const glm::dvec3& position_ws_m) {
    const glm::dvec4 p = glm::dmat4(view.map_from_anchor) * glm::dvec4(position_ws_m - view.anchor_ws_m, 1.0);
    if (!(p.w > 0.0)) return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    return glm::dvec3(p) / p.w;
}

Offset offset_at(const View& view, const glm::dvec3& position_ws_m, const glm::dvec3& normal_ws, double error_m,
                 double normal_error_rad) {
    const glm::dvec3 n_map = in_map(view, normal_ws);
    const glm::dvec3 from_anchor_m = position_ws_m - view.anchor_ws_m;
    if (view.kind == ViewKind::orthographic)
        return orthographic_offset(view, n_map, error_m + kPositionRounding * sum_of(from_anchor_m), normal_error_rad);
    return perspective_offset(view, n_map, in_map(view, position_ws_m - view.eye_ws_m),
                              error_m + kPositionRounding * glm::length(from_anchor_m), normal_error_rad);
}

}  // namespace gnomon::core
