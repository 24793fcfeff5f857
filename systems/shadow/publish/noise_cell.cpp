#include "systems/shadow/publish/noise_cell.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gnomon::shadow {
namespace {

/// Cells after which the lattice repeats: 2^24, the integers that a float counts exactly.
constexpr double kCells = 16777216.0;

/// The lattice's axes, as in noise_seed.glsl: the rotation of the quaternion (1, 2, 3, 4) / sqrt 30.
const glm::dvec3 kAxes[3] = {{-20.0 / 30.0, 4.0 / 30.0, 22.0 / 30.0},
                             {20.0 / 30.0, -10.0 / 30.0, 20.0 / 30.0},
                             {10.0 / 30.0, 28.0 / 30.0, 4.0 / 30.0}};

}  // namespace

NoiseCell seed_cell(const glm::dvec3& camera_ws_m, double cell_m) {
    NoiseCell at;
    for (int i = 0; i < 3; ++i) {
        const double along = glm::dot(kAxes[i], camera_ws_m) / cell_m;
        const double whole = glm::floor(along);
        at.place[i] = along - whole;
        at.cell[i] = static_cast<int>(whole - kCells * glm::floor(whole / kCells));
    }
    return at;
}

}  // namespace gnomon::shadow
