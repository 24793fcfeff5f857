#include "sample_game/game/collision_boxes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gnomon::game {
namespace {

constexpr int kRounds = 4;  // leaving one box may enter its neighbour: a corner needs two, a nook three

/// A solid in the world: the frame of its node without its scale.
struct Placed {
    glm::dmat3 turn;
    glm::dvec3 origin_ws_m, min_m, max_m;
};

Placed placed(const Solid& solid, std::span<const WorldTransform> poses) {
    const WorldTransform& pose = poses[solid.node];
    Placed p{pose.basis, pose.translation_ws_m, solid.min_m, solid.max_m};
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const double length = glm::length(pose.basis[axis]);
        p.turn[axis] /= length;
        p.min_m[axis] *= length;
        p.max_m[axis] *= length;
    }
    return p;
}

/// Returns a place on the ground in the solid's own frame.
glm::dvec2 in_plan(const Placed& p, const glm::dvec2& at_ws_m) {
    const glm::dvec3 at =
        glm::transpose(p.turn) * glm::dvec3(at_ws_m.x - p.origin_ws_m.x, 0.0, at_ws_m.y - p.origin_ws_m.z);
    return {at.x, at.z};
}

/// Returns the way out of a rectangle for a circle at `centre`; zero if they do not overlap.
glm::dvec2 way_out(const glm::dvec2& centre, double radius, const glm::dvec2& min, const glm::dvec2& max) {
    const glm::dvec2 nearest = glm::clamp(centre, min, max), away = centre - nearest;
    const double distance = glm::length(away);
    if (distance >= radius) return glm::dvec2(0.0);
    if (distance > 0.0) return away * ((radius - distance) / distance);
    const double left = centre.x - min.x, right = max.x - centre.x, back = centre.y - min.y, front = max.y - centre.y;
    const double least = std::min({left, right, back, front});
    if (least == left) return {-(left + radius), 0.0};
    if (least == right) return {right + radius, 0.0};
    return {0.0, least == back ? -(back + radius) : front + radius};
}

}  // namespace

glm::dvec2 pushed_out(glm::dvec2 centre_m, double radius_m, double low_m, double high_m, std::span<const Solid> solids,
                      std::span<const WorldTransform> poses) {
    for (int round = 0; round < kRounds; ++round) {
        bool moved = false;
        for (const Solid& solid : solids) {
            const Placed p = placed(solid, poses);
            if (p.origin_ws_m.y + p.max_m.y < low_m || p.origin_ws_m.y + p.min_m.y > high_m) continue;
            const glm::dvec2 out =
                way_out(in_plan(p, centre_m), radius_m, {p.min_m.x, p.min_m.z}, {p.max_m.x, p.max_m.z});
            if (out == glm::dvec2(0.0)) continue;
            const glm::dvec3 out_ws = p.turn * glm::dvec3(out.x, 0.0, out.y);
            centre_m += glm::dvec2(out_ws.x, out_ws.z);
            moved = true;
        }
        if (!moved) break;
    }
    return centre_m;
}

double ground_below(glm::dvec2 centre_m, double radius_m, double reach_m, double floor_m, std::span<const Solid> solids,
                    std::span<const WorldTransform> poses) {
    double ground_m = floor_m;
    for (const Solid& solid : solids) {
        const Placed p = placed(solid, poses);
        const double top_m = p.origin_ws_m.y + p.max_m.y;
        if (!(top_m > ground_m && top_m <= reach_m)) continue;
        const glm::dvec2 at = in_plan(p, centre_m);
        const glm::dvec2 nearest = glm::clamp(at, {p.min_m.x, p.min_m.z}, {p.max_m.x, p.max_m.z});
        if (glm::distance(at, nearest) < radius_m) ground_m = top_m;
    }
    return ground_m;
}

double free_way(const glm::dvec3& from_ws_m, const glm::dvec3& to_ws_m, std::span<const Solid> solids,
                std::span<const WorldTransform> poses) {
    double free = 1.0;
    for (const Solid& solid : solids) {
        const Placed p = placed(solid, poses);
        const glm::dvec3 from = glm::transpose(p.turn) * (from_ws_m - p.origin_ws_m);
        const glm::dvec3 along = glm::transpose(p.turn) * (to_ws_m - from_ws_m);
        double enter = 0.0, leave = free;
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            if (along[axis] == 0.0) {
                if (from[axis] < p.min_m[axis] || from[axis] > p.max_m[axis]) leave = -1.0;
                continue;
            }
            const double a = (p.min_m[axis] - from[axis]) / along[axis];
            const double b = (p.max_m[axis] - from[axis]) / along[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        if (enter <= leave) free = std::min(free, enter);
    }
    return free;
}

}  // namespace gnomon::game
