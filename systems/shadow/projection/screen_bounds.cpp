#include "systems/shadow/projection/screen_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <span>

#include "engine/math/cone.h"
#include "engine/math/frustum.h"
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

/// Returns the pixels that lie at least partly in a rectangle from `low` to `high`, both in [-1,1].
gl::Rect pixels_of(const glm::dvec2& low, const glm::dvec2& high, const glm::uvec2& viewport_px) {
    const glm::dvec2 size(viewport_px);
    const glm::dvec2 from = glm::clamp(glm::floor((low * 0.5 + 0.5) * size) - 1.0, glm::dvec2(0.0), size);
    const glm::dvec2 to = glm::clamp(glm::ceil((high * 0.5 + 0.5) * size) + 1.0, glm::dvec2(0.0), size);
    if (!(from.x < to.x && from.y < to.y)) return {};
    return {static_cast<std::int32_t>(from.x), static_cast<std::int32_t>(from.y),
            static_cast<std::int32_t>(to.x - from.x), static_cast<std::int32_t>(to.y - from.y)};
}

/// Rectangle around places of a picture, in [-1,1] on both axes. Empty at first.
struct PictureBounds {
    glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec2& place) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    /// Adds the part of a segment between homogeneous places (x, y, w) that the picture shows.
    void add_segment(const glm::dvec3& from, const glm::dvec3& to) {
        double first = 0.0, last = 1.0;
        const auto clip = [&](double at_from, double at_to) {  // inside where positive
            if (at_from < 0.0 && at_to < 0.0) last = -1.0;
            if (at_from < 0.0 && at_to >= 0.0) first = std::max(first, at_from / (at_from - at_to));
            if (at_from >= 0.0 && at_to < 0.0) last = std::min(last, at_from / (at_from - at_to));
        };
        for (int axis = 0; axis < 2; ++axis) {
            clip(from.z - from[axis], to.z - to[axis]);
            clip(from.z + from[axis], to.z + to[axis]);
        }
        if (first > last) return;
        for (const double share : {first, last}) {
            const glm::dvec3 place = from + share * (to - from);
            if (place.z > 0.0) add(glm::dvec2(place) / place.z);
        }
    }
};

/// Returns whether the places start + t * way with t from `first` on meet the convex volume of the planes.
bool ray_meets(std::span<const math::Plane> planes, const glm::dvec3& start, const glm::dvec3& way, double first) {
    double last = std::numeric_limits<double>::infinity();
    for (const math::Plane& plane : planes) {
        const double at_start = glm::dot(plane.normal, start) + plane.offset, along = glm::dot(plane.normal, way);
        if (along > 0.0) first = std::max(first, -at_start / along);
        if (along < 0.0) last = std::min(last, -at_start / along);
        if (along == 0.0 && at_start < 0.0) return false;
    }
    return first <= last;
}

/// Returns the pixels that show something in a spot's cone, which has no end. A pyramid stands for the cone. What a
/// camera sees of it lies between its apex and the vanishing points of its edges. The extremes of that part of the
/// picture lie on segments between these places, or are corners of the picture.
gl::Rect cone_rectangle(const LightItem& light, const ConsumerItem& c) {
    constexpr double kWidest_rad = 1.4;  // wider pyramids leave little of a picture, and their corners are far out
    const math::Cone cone{light.position_ws_m, -light.rotation_ws[2], light.outer_cone_rad + kRounding};
    const gl::Rect whole{0, 0, static_cast<std::int32_t>(c.viewport_px.x), static_cast<std::int32_t>(c.viewport_px.y)};
    if (!(cone.half_angle_rad < kWidest_rad)) return whole;
    const bool orthographic = c.projection == CameraProjection::orthographic;
    const glm::dvec2 half = half_extent(c);
    const auto place = [&](const glm::dvec3& way_ws, double is_point) {
        const glm::dvec3 p = way_ws * c.rotation_ws;  // view axes
        return glm::dvec3(glm::dvec2(p) / half, orthographic ? is_point : -p.z);
    };
    std::array<glm::dvec3, math::kConeSides + 1> places;
    const auto edges = math::edges_around(cone);
    for (std::size_t i = 0; i < edges.size(); ++i) places[i] = place(edges[i], 0.0);
    places.back() = place(cone.apex - c.position_ws_m, 1.0);
    PictureBounds bounds;
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) bounds.add_segment(places[j], places[i]);
    const auto planes = math::planes_around(cone);
    for (const glm::dvec2 corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
        const glm::dvec2 at = corner * half;
        const glm::dvec3 ahead_ws = -c.rotation_ws[2], aside_ws = c.rotation_ws[0] * at.x + c.rotation_ws[1] * at.y;
        // An orthographic camera may also show what is behind its place.
        const bool meets = orthographic ? ray_meets(planes, c.position_ws_m + aside_ws, ahead_ws,
                                                    -std::numeric_limits<double>::infinity())
                                        : ray_meets(planes, c.position_ws_m, ahead_ws + aside_ws, 0.0);
        if (meets) bounds.add(corner);
    }
    return bounds.low.x <= bounds.high.x ? pixels_of(bounds.low, bounds.high, c.viewport_px) : gl::Rect{};
}

}  // namespace

gl::Rect screen_rectangle(const LightItem& light, const ConsumerItem& c) {
    const gl::Rect whole{0, 0, static_cast<std::int32_t>(c.viewport_px.x), static_cast<std::int32_t>(c.viewport_px.y)};
    if (light_facts(light.kind).parallel) return whole;
    const auto unbounded = [&] { return light_facts(light.kind).cone ? cone_rectangle(light, c) : whole; };
    if (!(light.range_m > 0.0)) return unbounded();
    const Ball ball = reached_ball(light);
    const glm::dvec3 p = (ball.centre_ws_m - c.position_ws_m) * c.rotation_ws;  // view axes
    const double r = ball.radius_m;
    const bool orthographic = c.projection == CameraProjection::orthographic;
    const double front_m = -p.z + r;  // farthest part of the sphere along the view
    if (!(front_m > c.near_m) || -p.z - r > c.far_m) return {};
    if (!orthographic && !(-p.z - r > c.near_m)) return unbounded();  // the sphere reaches the near plane
    const glm::dvec2 half = half_extent(c);
    glm::dvec2 low, high;
    for (int axis = 0; axis < 2; ++axis) {
        // Box around the sphere: its near and far side bound the projection from both sides.
        const double z_near = orthographic ? 1.0 : -p.z - r, z_far = orthographic ? 1.0 : -p.z + r;
        const double lowest = p[axis] - r, highest = p[axis] + r;
        low[axis] = (lowest < 0.0 ? lowest / z_near : lowest / z_far) / half[axis];
        high[axis] = (highest > 0.0 ? highest / z_near : highest / z_far) / half[axis];
    }
    return pixels_of(low, high, c.viewport_px);
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
