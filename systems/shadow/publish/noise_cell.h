#pragma once
#include <glm/vec3.hpp>

namespace gnomon::shadow {

/// Place of a camera in the lattice of cells that seeds filters (shaders/shadow/filters/disk/noise_seed.glsl). The
/// lattice wraps. It is turned against the world's axes, so that no wall along a cell's side alternates between two
/// cells by rounding.
struct NoiseCell {
    glm::ivec3 cell{0};     // 0 to 2^24 - 1
    glm::dvec3 place{0.0};  // within the cell, 0 to 1
};

/// Returns the camera's place. `cell_m`: edge of a cell, metres, above 0.
NoiseCell seed_cell(const glm::dvec3& camera_ws_m, double cell_m);

}  // namespace gnomon::shadow
