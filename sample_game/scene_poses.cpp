#include "sample_game/scene_poses.h"

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

math::Aabb scene_bounds(const assets::SceneData& scene, const std::vector<WorldTransform>& poses) {
    math::Aabb bounds;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].mesh == assets::kNone) continue;
        const math::Aabb& mesh = scene.meshes[static_cast<std::size_t>(scene.nodes[i].mesh)].bounds_ms;
        if (math::is_empty(mesh)) continue;
        const math::Aabb box = math::transformed(mesh, poses[i].basis, poses[i].translation_ws_m);
        if (math::is_finite(box)) bounds = math::merged(bounds, box);
    }
    return bounds;
}

}  // namespace gnomon::game
