#pragma once
#include <cstdint>
#include <vector>

#include "gnomon/assets.h"

namespace gnomon::assets {

inline Mesh mesh_of(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices) {
    Mesh mesh;
    for (const glm::vec3& position : positions) mesh.vertices.push_back({position, {}, {}});
    mesh.indices = indices;
    return mesh;
}

/// A cube that shares its eight corners, wound outward.
inline const std::vector<glm::vec3> kCorners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                                {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
inline const std::vector<std::uint32_t> kCubeFaces = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                                      2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

}  // namespace gnomon::assets
