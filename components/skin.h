#pragma once
#include <glm/mat4x3.hpp>
#include <vector>

#include "engine/ecs/entity.h"

namespace gnomon {

/// Add this to an entity whose MeshRef names a mesh with joints (assets::Mesh::deformer), and the mesh follows those
/// entities; its own Transform is then of no account, as glTF has it. All entities that name one mesh look alike, bent
/// as the one with the lowest entity index says: give each its own copy of the mesh to bend them apart.
struct Skin {
    std::vector<ecs::Entity> joints = {};         // with Transform; one that has none leaves what follows it at rest
    std::vector<glm::dmat4x3> inverse_bind = {};  // one per joint: from the mesh at rest to the joint at rest
};

}  // namespace gnomon
