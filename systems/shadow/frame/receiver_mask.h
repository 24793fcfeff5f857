#pragma once
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace gnomon::shadow {

/// Grid over a sun's map with the cells that visible receivers cover.
struct ReceiverMask {
    static constexpr int kCells = 256;  // along a side: cells of a cascade of kilometres are as large as houses

    glm::dvec3 origin_ws_m{0.0};
    glm::dmat3 axes{1.0};   // columns u, v, toward the light
    glm::dvec2 low_m{0.0};  // lower corner of the map from the origin, along u and v
    glm::dvec2 cells_per_m{0.0};
    /// Number of covered cells before each column and row, (kCells + 1)^2 (summed-area table, Crow 1984).
    std::vector<std::uint32_t> sums;
};

}  // namespace gnomon::shadow
