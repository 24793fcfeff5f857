#pragma once
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace gnomon::shadow {

/// Grid over a sun's map with the cells that visible receivers cover.
struct ReceiverMask {
    /// Limits of `cells`. At most: cells of a cascade of kilometres are as large as houses, and filling them takes half
    /// a million instructions. Fewest: those take a sixtieth of that.
    static constexpr int kFewestCells = 32, kMostCells = 256;

    int cells = kFewestCells;  // along a side
    glm::dvec3 origin_ws_m{0.0};
    glm::dmat3 axes{1.0};   // columns u, v, toward the light
    glm::dvec2 low_m{0.0};  // lower corner of the map from the origin, along u and v
    glm::dvec2 cells_per_m{0.0};
    /// Number of covered cells before each column and row, (cells + 1)^2 (summed-area table, Crow 1984).
    std::vector<std::uint32_t> sums;
};

}  // namespace gnomon::shadow
