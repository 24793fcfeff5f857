#include "systems/shadow/update/stale_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gnomon::shadow {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Pose {
    std::uint64_t since = 0;
    double bent_m = 0.0;
};
Pose read(const PoseItem* pose) { return pose ? Pose{pose->since, pose->bent_m} : Pose{}; }

/// Returns the length of a vector across the light. It is convex, as is the distance along the light, so that a box's
/// corners bound the whole box.
double across_m(const ShadowView& view, const glm::dvec3& v) {
    return std::hypot(glm::dot(v, view.pose.axis_u), glm::dot(v, view.pose.axis_v));
}

/// Returns the largest tangent inside the view's map.
double widest_tangent(const ShadowView& view) {
    const glm::dvec2 side = glm::max(glm::abs(view.plane.tan_low), glm::abs(view.plane.tan_high));
    return glm::length(side);
}

/// Returns the least distance of a box from the light along the view's axis, metres. Negative behind the light.
double least_distance_m(const ShadowView& view, const math::Aabb& box) {
    double least_m = kInfinity;
    for (const glm::dvec3& corner : math::corners(box))
        least_m = std::min(least_m, glm::dot(apex_ws_m(view) - corner, view.pose.axis_back));
    return least_m;
}

/// Greatest movement of a box's points, metres: in any direction, across and along the light. Each point moves by up to
/// `bent_m` beside the instance's own movement.
struct BoxShift {
    double any_m = 0.0, across_m = 0.0, along_m = 0.0;
};
BoxShift box_shift(const ShadowView& view, const ShownCaster& then, const InstanceItem& now, double bent_m) {
    const glm::dmat3 turn = now.basis * glm::inverse(then.basis);
    BoxShift most;
    for (const glm::dvec3& corner : math::corners(then.bounds_ws)) {
        const glm::dvec3 moved = turn * (corner - then.translation_ws_m) + (now.translation_ws_m - corner);
        const double any_m = glm::length(moved);
        if (!(any_m < kInfinity)) return {kInfinity, kInfinity, kInfinity};
        most.any_m = std::max(most.any_m, any_m);
        most.across_m = std::max(most.across_m, across_m(view, moved));
        most.along_m = std::max(most.along_m, std::abs(glm::dot(moved, view.pose.axis_back)));
    }
    return {most.any_m + bent_m, most.across_m + bent_m, most.along_m + bent_m};
}

/// Returns a bound on the factor by which the linear map lengthens a vector (its Frobenius norm).
double longest(const glm::dmat3& basis) {
    return std::sqrt(glm::dot(basis[0], basis[0]) + glm::dot(basis[1], basis[1]) + glm::dot(basis[2], basis[2]));
}

}  // namespace

void remember(const SceneSnapshot& scene, std::span<const std::uint32_t> casters, std::uint64_t static_content,
              ShownCasters& shown) {
    shown.still = static_content;
    shown.moving.clear();
    for (const std::uint32_t i : casters) {
        const InstanceItem& item = scene.instances[i];
        const Pose pose =
            item.drawable.drawn ? Pose{item.drawable.since, item.drawable.moved_m} : read(pose_of(scene, item.mesh));
        shown.moving.push_back({item.gpu_slot, item.mesh, item.version, item.basis, item.translation_ws_m,
                                item.bounds_ws, pose.since, pose.bent_m, item.mesh_version});
    }
}

CasterShift caster_shift(const ShadowView& view, const ShownCaster& then, const InstanceItem& now,
                         const PoseItem* pose) {
    if (then.version == now.version) return {};
    const bool drawn = now.drawable.drawn;
    const Pose bends = drawn ? Pose{now.drawable.since, now.drawable.moved_m} : read(pose);
    if (bends.since != then.bends_since) return {kInfinity, kInfinity};
    const double bent_m = (bends.bent_m - then.bent_m) * (drawn ? 1.0 : longest(now.basis));
    // The points of a drawable need not move with its box.
    const BoxShift shift = drawn ? BoxShift{bent_m, bent_m, bent_m} : box_shift(view, then, now, bent_m);
    if (is_parallel(view)) return {shift.any_m, shift.across_m};
    // x1/z1 - x0/z0 = ((x1 - x0) - (x0/z0)(z1 - z0)) / z1, and the same with 0 and 1 swapped. The form with a tangent
    // inside the map applies. If neither place is inside, neither is visible.
    const double distance_m = std::min(least_distance_m(view, then.bounds_ws), least_distance_m(view, now.bounds_ws));
    if (!(distance_m > 0.0)) return {kInfinity, kInfinity};
    return {shift.any_m, (shift.across_m + widest_tangent(view) * shift.along_m) / distance_m};
}

Staleness staleness(const SceneSnapshot& scene, const ShadowView& view, const ShownCasters& shown,
                    std::uint64_t static_content, std::span<const std::uint32_t> casters) {
    const auto moving = casters.subspan(std::min<std::size_t>(view.static_casters, casters.size()));
    // What proxies need is an offset of its own.
    if (view.error.proxy_m > 0.0 || shown.proxy_m > 0.0) return kUnknownStaleness;
    if (shown.still != static_content || shown.moving.size() != moving.size() || !(view.error.metre_px > 0.0))
        return kUnknownStaleness;
    CasterShift most;
    for (std::size_t i = 0; i < moving.size(); ++i) {
        const InstanceItem& now = scene.instances[moving[i]];
        const ShownCaster& then = shown.moving[i];
        const bool same = now.gpu_slot == then.gpu_slot && now.mesh == then.mesh;
        if (!same || now.mesh_version != then.mesh_version) return kUnknownStaleness;
        const CasterShift shift = caster_shift(view, then, now, pose_of(scene, now.mesh));
        if (!(shift.any_m < kInfinity && shift.across < kInfinity)) return kUnknownStaleness;
        most = {std::max(most.any_m, shift.any_m), std::max(most.across, shift.across)};
    }
    const bool orthographic = is_parallel(view);
    // In a perspective view, tangents convert to pixels by the texel's own size in tangents.
    const double across_px =
        orthographic ? view.error.metre_px
                     : view.error.extent_px / glm::length(glm::dvec2(view.plane.texel_u, view.plane.texel_v));
    return {most.any_m, most.across * across_px + most.any_m * view.error.metre_px};
}

}  // namespace gnomon::shadow
