#include "engine/mesh/mesh_shape.h"

#include <vector>

#include "engine/math/shape_tree.h"

namespace gnomon::assets {

std::shared_ptr<const math::ShapeTree> shape_of(const Mesh& mesh) {
    std::vector<math::FloatBox> boxes(mesh.indices.size() / 3);
    for (std::size_t t = 0; t < boxes.size(); ++t)
        for (std::size_t corner = 3 * t; corner < 3 * t + 3; ++corner) {
            const glm::vec3& position_ms = mesh.vertices[mesh.indices[corner]].position_ms;
            boxes[t] = {glm::min(boxes[t].min, position_ms), glm::max(boxes[t].max, position_ms)};
        }
    if (boxes.empty()) return nullptr;
    return std::make_shared<const math::ShapeTree>(boxes);
}

}  // namespace gnomon::assets
