#include "systems/shadow/projection/screen_bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "systems/extract/light_facts.h"
#include "systems/extract/volumes.h"

namespace gnomon::shadow {
namespace {

struct Ball {
    glm::dvec3 centre_ws_m{0.0};
    double radius_m = 0.0;
};

constexpr double kRounding = 1.0e-5;  // relative error of distances and cosines in the shaders' float

/// Returns the smallest ball around the volume that a local light of limited range reaches.
Ball reached_ball(const LightItem& light) {
    const double range_m = light.range_m * (1.0 + kRounding);
    if (!light_facts(light.kind).cone) return {light.position_ws_m, range_m};
    const double angle_rad = std::min(light.outer_cone_rad + kRounding, 0.5 * glm::pi<double>());
    const glm::dvec3 ahead = -light.rotation_ws[2];
    // The ball of a narrow cone passes through apex and rim. A wide cone's has the rim as its equator.
    if (angle_rad <= 0.25 * glm::pi<double>()) {
        const double radius_m = 0.5 * range_m / std::cos(angle_rad);
        return {light.position_ws_m + ahead * radius_m, radius_m};
    }
    return {light.position_ws_m + ahead * (range_m * std::cos(angle_rad)), range_m * std::sin(angle_rad)};
}

}  // namespace

gl::Rect screen_rectangle(const LightItem& light, const ConsumerItem& c) {
    const gl::Rect whole{0, 0, static_cast<std::int32_t>(c.viewport_px.x), static_cast<std::int32_t>(c.viewport_px.y)};
    if (light_facts(light.kind).parallel || !(light.range_m > 0.0)) return whole;
    const Ball ball = reached_ball(light);
    const glm::dvec3 p = (ball.centre_ws_m - c.position_ws_m) * c.rotation_ws;  // view axes
    const double r = ball.radius_m;
    const bool orthographic = c.projection == CameraProjection::orthographic;
    const double front_m = -p.z + r;  // farthest part of the sphere along the view
    if (!(front_m > c.near_m) || -p.z - r > c.far_m) return {};
    if (!orthographic && !(-p.z - r > c.near_m)) return whole;  // the sphere reaches the near plane
    const double half_y = orthographic ? c.half_height_m : std::tan(0.5 * c.fov_y_rad);
    const glm::dvec2 half(half_y * aspect(c), half_y);
    glm::dvec2 low, high;
    for (int axis = 0; axis < 2; ++axis) {
        // Box around the sphere: its near and far side bound the projection from both sides.
        const double z_near = orthographic ? 1.0 : -p.z - r, z_far = orthographic ? 1.0 : -p.z + r;
        const double lowest = p[axis] - r, highest = p[axis] + r;
        low[axis] = (lowest < 0.0 ? lowest / z_near : lowest / z_far) / half[axis];
        high[axis] = (highest > 0.0 ? highest / z_near : highest / z_far) / half[axis];
    }
    const glm::dvec2 size(c.viewport_px);
    const glm::dvec2 from = glm::clamp(glm::floor((low * 0.5 + 0.5) * size) - 1.0, glm::dvec2(0.0), size);
    const glm::dvec2 to = glm::clamp(glm::ceil((high * 0.5 + 0.5) * size) + 1.0, glm::dvec2(0.0), size);
    if (!(from.x < to.x && from.y < to.y)) return {};
    return {static_cast<std::int32_t>(from.x), static_cast<std::int32_t>(from.y),
            static_cast<std::int32_t>(to.x - from.x), static_cast<std::int32_t>(to.y - from.y)};
}

float depth_bound(double farthest_m, const ConsumerItem& c) {
    const bool orthographic = c.projection == CameraProjection::orthographic;
    farthest_m += kRounding * (orthographic ? c.far_m : farthest_m);
    if (!(farthest_m > c.near_m)) return 1.0f;
    const double depth = orthographic ? (c.far_m - farthest_m) / (c.far_m - c.near_m)
                         : std::isinf(c.far_m)
                             ? c.near_m / farthest_m
                             : c.near_m * (c.far_m - farthest_m) / (farthest_m * (c.far_m - c.near_m));
    return static_cast<float>(std::clamp(depth, 0.0, 1.0));
}

float farthest_depth(const LightItem& light, const ConsumerItem& c) {
    if (light_facts(light.kind).parallel || !(light.range_m > 0.0)) return 0.0f;
    const Ball ball = reached_ball(light);
    return depth_bound(glm::dot(c.position_ws_m - ball.centre_ws_m, c.rotation_ws[2]) + ball.radius_m, c);
}

}  // namespace gnomon::shadow
