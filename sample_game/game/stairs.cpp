#include "sample_game/game/stairs.h"

#include <array>
#include <glm/common.hpp>
#include <map>

namespace gnomon::game {

std::vector<Solid> treads_of(const assets::Mesh& mesh, std::size_t node) {
    std::map<float, math::Aabb> treads;  // by height
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<glm::dvec3, 3> corner;
        for (std::size_t k = 0; k < 3; ++k) corner[k] = glm::dvec3(mesh.vertices[mesh.indices[i + k]].position_ms);
        const glm::dvec3 a = corner[1] - corner[0], b = corner[2] - corner[0];
        const bool level = a.y == 0.0 && b.y == 0.0;
        if (!level || !(a.z * b.x - a.x * b.z > 0.0)) continue;
        math::Aabb& tread = treads[static_cast<float>(corner[0].y)];
        for (const glm::dvec3& point : corner) {
            tread.min = glm::min(tread.min, point);
            tread.max = glm::max(tread.max, point);
        }
    }
    std::vector<Solid> solids;
    for (const auto& [height, tread] : treads)
        solids.push_back({node, {tread.min.x, mesh.bounds_ms.min.y, tread.min.z}, tread.max});
    return solids;
}

}  // namespace gnomon::game
