#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "gnomon/components.h"

/// Obstacles of a walker: upright boxes that stand, turn and move with nodes of the scene.
namespace gnomon::game {

/// Box in the frame of its node. The node's +Y stays upright.
struct Solid {
    std::size_t node = 0;
    glm::dvec3 min_m{0.0}, max_m{0.0};
};

/// Moves an upright circle out of every solid that stands between the heights `low_m` and `high_m`.
/// Returns its centre (x, z). In a corner narrower than the circle some overlap remains.
glm::dvec2 pushed_out(glm::dvec2 centre_m, double radius_m, double low_m, double high_m, std::span<const Solid> solids,
                      std::span<const WorldTransform> poses);

/// Returns the height that an upright circle stands on: the highest top of the solids below it that is not above
/// `reach_m`; else `floor_m`.
double ground_below(glm::dvec2 centre_m, double radius_m, double reach_m, double floor_m, std::span<const Solid> solids,
                    std::span<const WorldTransform> poses);

/// Returns the fraction of the way to `to_ws_m` at which the first solid is met; 1: none is.
double free_way(const glm::dvec3& from_ws_m, const glm::dvec3& to_ws_m, std::span<const Solid> solids,
                std::span<const WorldTransform> poses);

}  // namespace gnomon::game
