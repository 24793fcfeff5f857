#include "tests/oracle/posed_positions.h"

#include <cstddef>

namespace gnomon::oracle {

std::vector<glm::dvec3> posed_positions(const SceneSnapshot& snapshot, const assets::MeshLibrary& library,
                                        std::uint32_t mesh_index) {
    const assets::Mesh& mesh = library.meshes[mesh_index];
    std::vector<glm::dvec3> positions;
    for (const assets::Vertex& vertex : mesh.vertices) positions.emplace_back(vertex.position_ms);
    const PoseItem* pose = nullptr;
    for (const PoseItem& candidate : snapshot.poses)
        if (candidate.mesh == mesh_index) pose = &candidate;
    if (!pose || !mesh.deformer) return positions;
    const assets::Deformer& deformer = *mesh.deformer;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        glm::dvec3 at = positions[v];
        for (std::size_t t = 0; t < deformer.targets.size(); ++t)
            if (!deformer.targets[t].positions.empty())
                at += static_cast<double>(pose->weights[t]) * glm::dvec3(deformer.targets[t].positions[v]);
        if (pose->skinned) {
            glm::dvec3 sum(0.0);
            double weights = 0.0;
            for (std::uint32_t i = deformer.first_influence[v]; i < deformer.first_influence[v + 1]; ++i) {
                const auto& [joint, weight] = deformer.influences[i];
                sum += static_cast<double>(weight) * (pose->joints[joint] * glm::dvec4(at, 1.0));
                weights += static_cast<double>(weight);
            }
            at = sum / weights;
        }
        positions[v] = at;
    }
    return positions;
}

}  // namespace gnomon::oracle
