#pragma once
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/box.h"
#include "gnomon/components.h"

namespace gnomon::game {

/// Returns the box about all placed meshes, bent by their joints and weights; empty if there is none. It leaves out
/// nodes with a box that is not finite.
math::Aabb scene_bounds(const assets::SceneData& scene, const std::vector<WorldTransform>& poses);

}  // namespace gnomon::game
