#include "sample_game/inside/scene_bounds.h"

#include "engine/math/aabb.h"
#include "engine/mesh/deformer.h"

namespace gnomon::game {
namespace {

/// Returns a mesh's bounds in its node's own space; in world space where joints place the mesh.
math::Aabb bounds_at_rest(const assets::SceneData& scene, const assets::Node& node,
                          const std::vector<WorldTransform>& poses) {
    const assets::Mesh& mesh = scene.meshes[static_cast<std::size_t>(node.mesh)];
    if (!mesh.deformer) return mesh.bounds_ms;
    std::vector<glm::dmat4x3> joints;
    if (node.skin != assets::kNone) {
        const assets::Skin& skin = scene.skins[static_cast<std::size_t>(node.skin)];
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            const WorldTransform& joint = poses[static_cast<std::size_t>(skin.joints[j])];
            const glm::dmat4x3& bind = skin.inverse_bind[j];
            joints.emplace_back(joint.basis * bind[0], joint.basis * bind[1], joint.basis * bind[2],
                                joint.basis * bind[3] + joint.translation_ws_m);
        }
    }
    return assets::posed_bounds(mesh, {joints, node.morph_weights});
}

}  // namespace

math::Aabb scene_bounds(const assets::SceneData& scene, const std::vector<WorldTransform>& poses) {
    math::Aabb bounds;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].mesh == assets::kNone) continue;
        const math::Aabb mesh = bounds_at_rest(scene, scene.nodes[i], poses);
        if (math::is_empty(mesh)) continue;
        const bool placed_by_joints = scene.nodes[i].skin != assets::kNone;
        const math::Aabb box =
            placed_by_joints ? mesh : math::transformed(mesh, poses[i].basis, poses[i].translation_ws_m);
        if (math::is_finite(box)) bounds = math::merged(bounds, box);
    }
    return bounds;
}

}  // namespace gnomon::game
