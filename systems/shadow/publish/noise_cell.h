#pragma once
#include <glm/vec3.hpp>

namespace gnomon::shadow {

/// Where a camera stands in the lattice of cells that seeds filters (shaders/shadow/filters/disk/noise_seed.glsl). The
/// lattice is turned against the world's axes, lest a wall lie along a cell's side and rounding choose between two; it
/// wraps.
struct SeedCell {
    glm::ivec3 cell{0};     // 0 to 2^24 - 1
    glm::dvec3 place{0.0};  // within it, 0 to 1
};

/// `cell_m`: edge of a cell, above 0.
SeedCell seed_cell(const glm::dvec3& camera_ws_m, double cell_m);

}  // namespace gnomon::shadow
