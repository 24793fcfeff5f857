#pragma once
#include <glm/mat4x3.hpp>
#include <vector>

#include "engine/ecs/entity.h"

namespace gnomon {

/// Bends the entity's mesh by joints, which are other entities. The mesh must have joints (assets::Mesh::deformer); the
/// entity's own Transform is ignored, as in glTF. All entities with the same mesh look alike: the one with the lowest
/// index sets its pose. For different poses, give each entity its own copy of the mesh.
struct Skin {
    std::vector<ecs::Entity> joints = {};  // entities with Transform; vertices of a joint without one stay at rest
    std::vector<glm::dmat4x3> inverse_bind = {};  // one per joint: joint space at rest from mesh space at rest
};

}  // namespace gnomon
