#pragma once
#include <optional>
#include <vector>

#include "components/transform.h"
#include "engine/assets/scene_data.h"
#include "engine/math/aabb.h"

namespace gnomon::game {

/// Where each node of `scene` is in the world, at rest. One entry per node.
std::vector<WorldTransform> world_poses(const assets::SceneData& scene);

/// Box about every placed mesh, bent as its joints and weights say; empty if there is none. Nodes whose box is not
/// finite are left out.
math::Aabb scene_bounds(const assets::SceneData& scene, const std::vector<WorldTransform>& poses);

}  // namespace gnomon::game
