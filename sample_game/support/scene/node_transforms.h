#pragma once
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/components.h"

namespace gnomon::game {

/// Returns where each node of `scene` is in the world, at rest. One entry per node.
std::vector<WorldTransform> world_poses(const assets::SceneData& scene);

}  // namespace gnomon::game
