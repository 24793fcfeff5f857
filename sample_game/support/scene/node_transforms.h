#pragma once
#include <optional>
#include <vector>

#include "engine/math/aabb.h"
#include "gnomon/assets.h"
#include "gnomon/components.h"

namespace gnomon::game {

/// Returns where each node of `scene` is in the world, at rest. One entry per node.
std::vector<WorldTransform> world_poses(const assets::SceneData& scene);

/// Returns the box about all placed meshes, bent by their joints and weights; empty if there is none. It leaves out
/// nodes with a box that is not finite.
math::Aabb scene_bounds(const assets::SceneData& scene, const std::vector<WorldTransform>& poses);

}  // namespace gnomon::game
