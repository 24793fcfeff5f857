#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/math/aabb.h"
#include "systems/extract/snapshot.h"

/// Closed-form truth about boxes above flat receivers. It shares no formula with the pipeline: rays in world space meet
/// boxes in their own space. It claims nothing within a margin around every edge.
namespace gnomon::boxes {

struct Box {
    math::Aabb box_ms;
    glm::dmat3 basis{1.0};  // columns orthogonal, may differ in length and be mirrored
    glm::dvec3 translation_m{0.0};
};

/// A flat rectangle: centre, half sides, facing cross(half_u, half_v).
struct Card {
    glm::dvec3 centre_m, half_u_m, half_v_m;
    glm::dvec3 normal() const { return glm::normalize(glm::cross(half_u_m, half_v_m)); }
};

/// Returns whether the segment from `a` to `b` meets the box grown by `grow_m` on every side (negative: shrunk).
inline bool meets(const Box& box, const glm::dvec3& a, const glm::dvec3& b, double grow_m) {
    const glm::dmat3 inverse = glm::inverse(box.basis);
    const glm::dvec3 from = inverse * (a - box.translation_m), way = inverse * (b - a);
    double enter = 0.0, leave = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double grow = grow_m / glm::length(box.basis[axis]);
        const double low = box.box_ms.min[axis] - grow, high = box.box_ms.max[axis] + grow;
        if (!(low < high)) return false;
        if (way[axis] == 0.0) {
            if (from[axis] < low || from[axis] > high) return false;
            continue;
        }
        const double t0 = (low - from[axis]) / way[axis], t1 = (high - from[axis]) / way[axis];
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
    }
    return enter <= leave;
}

struct Ray {
    glm::dvec3 origin, direction;
};
inline Ray pixel_ray(const ConsumerItem& camera, std::uint32_t x, std::uint32_t y) {
    const glm::dvec2 size(camera.viewport_px);
    const glm::dvec2 ndc = (glm::dvec2(x, y) + 0.5) / size * 2.0 - 1.0;
    const bool flat = camera.projection == CameraProjection::orthographic;
    const double half_y = flat ? camera.half_height_m : std::tan(0.5 * camera.fov_y_rad);
    const glm::dvec3 lateral = camera.rotation_ws[0] * (ndc.x * half_y * size.x / size.y) + camera.rotation_ws[1] * (ndc.y * half_y);
    if (flat) return {camera.position_ws_m + lateral, -camera.rotation_ws[2]};
    return {camera.position_ws_m, lateral - camera.rotation_ws[2]};
}

enum class Claim { none, dark, lit };

struct Scene {
    std::vector<Box> boxes;    // cast; also hide what lies behind them
    std::vector<Card> cards;   // receive
    double margin_m = 0.1;
    bool boxes_hide = true;    // false: the camera looks at the boxes' culled insides only
};

/// Returns what a light must do at a point of a card.
inline Claim claim_at(const Scene& scene, const Card& card, const glm::dvec3& p, const LightItem& light) {
    const double margin = scene.margin_m;
    glm::dvec3 source = light.position_ws_m;
    if (light.kind == LightKind::directional) {
        constexpr double kFar_m = 1.0e4;
        source = p + light.rotation_ws[2] * kFar_m;
    } else {
        const double distance_m = glm::distance(p, source);
        if (light.range_m > 0.0 && distance_m > light.range_m + margin) return Claim::dark;
        if (light.range_m > 0.0 && distance_m > light.range_m - margin) return Claim::none;
        if (light.kind == LightKind::spot) {
            const double angle = std::acos(std::clamp(glm::dot(p - source, -light.rotation_ws[2]) / distance_m, -1.0, 1.0));
            if (angle > light.outer_cone_rad + margin / distance_m) return Claim::dark;
            if (angle > light.outer_cone_rad - margin / distance_m) return Claim::none;
        }
    }
    if (!(glm::dot(source - p, card.normal()) > 0.0)) return Claim::dark;
    bool near_edge = false;
    for (const Box& box : scene.boxes) {
        if (meets(box, p, source, -margin)) return Claim::dark;
        near_edge = near_edge || meets(box, p, source, margin);
    }
    return near_edge ? Claim::none : Claim::lit;
}

/// Returns what the picture must show at a pixel.
inline Claim claim_of_pixel(const Scene& scene, const ConsumerItem& camera, const LightItem& light, std::uint32_t x,
                            std::uint32_t y) {
    const Ray ray = pixel_ray(camera, x, y);
    double nearest = std::numeric_limits<double>::infinity();
    const Card* seen = nullptr;
    for (const Card& card : scene.cards) {
        const double toward = glm::dot(ray.direction, card.normal());
        if (!(toward < 0.0)) continue;
        const double t = glm::dot(card.centre_m - ray.origin, card.normal()) / toward;
        if (!(t > 0.0) || t >= nearest) continue;
        const glm::dvec3 offset = ray.origin + ray.direction * t - card.centre_m;
        const double u = glm::length(card.half_u_m), v = glm::length(card.half_v_m);
        if (std::abs(glm::dot(offset, card.half_u_m)) / u > u - scene.margin_m) continue;
        if (std::abs(glm::dot(offset, card.half_v_m)) / v > v - scene.margin_m) continue;
        nearest = t;
        seen = &card;
    }
    if (!seen) return Claim::none;
    const glm::dvec3 p = ray.origin + ray.direction * nearest;
    if (scene.boxes_hide)
        for (const Box& box : scene.boxes)
            if (meets(box, ray.origin, p, scene.margin_m)) return Claim::none;
    return claim_at(scene, *seen, p, light);
}

struct Verdict {
    std::size_t dark = 0, lit = 0, wrong = 0;
    std::string first_wrong;
};

constexpr float kExact = 1.0e-5f;  // nine equal weights do not add up to one

/// Counts the claims, and the pixels that contradict one. `measured`: as of --visibility, rows bottom to top.
inline Verdict judge(const Scene& scene, const ConsumerItem& camera, const LightItem& light,
                     std::span<const float> measured, float tolerance = kExact) {
    Verdict verdict;
    for (std::uint32_t y = 0; y < camera.viewport_px.y; ++y)
        for (std::uint32_t x = 0; x < camera.viewport_px.x; ++x) {
            const Claim claim = claim_of_pixel(scene, camera, light, x, y);
            if (claim == Claim::none) continue;
            const float want = claim == Claim::lit ? 1.0f : 0.0f, got = measured[std::size_t{y} * camera.viewport_px.x + x];
            ++(claim == Claim::lit ? verdict.lit : verdict.dark);
            if (std::abs(got - want) <= tolerance) continue;
            if (verdict.wrong++ == 0)
                verdict.first_wrong = "pixel " + std::to_string(x) + ", " + std::to_string(y) + " is " +
                                      std::to_string(got) + ", not " + std::to_string(want);
        }
    return verdict;
}

}  // namespace gnomon::boxes
