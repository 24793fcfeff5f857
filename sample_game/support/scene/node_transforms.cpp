#include "sample_game/support/scene/node_transforms.h"

#include <glm/geometric.hpp>

namespace gnomon::game {

std::vector<WorldTransform> world_poses(const assets::SceneData& scene) {
    std::vector<WorldTransform> poses(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const assets::Node& node = scene.nodes[i];
        WorldTransform local{glm::mat3_cast(glm::normalize(node.rotation)), node.translation_m};
        for (glm::length_t axis = 0; axis < 3; ++axis) local.basis[axis] *= node.scale[axis];
        if (node.parent == assets::kNone) {
            poses[i] = local;
            continue;
        }
        const WorldTransform& parent = poses[static_cast<std::size_t>(node.parent)];  // parents come first
        poses[i] = {parent.basis * local.basis, parent.basis * local.translation_ws_m + parent.translation_ws_m};
    }
    return poses;
}

}  // namespace gnomon::game
