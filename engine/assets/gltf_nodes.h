#pragma once
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "engine/assets/gltf_mesh.h"
#include "engine/assets/scene_data.h"

namespace gnomon::assets::gltf {

/// Fills scene.nodes from the default scene (else the first scene, else all roots), depth first, parents before
/// children, and splits a light in two where its nodes disagree about its shadow. Needs meshes, cameras and lights.
/// A cycle, a second parent or a node too deep is an error, wherever in the file it stands. A node whose matrix shears
/// becomes two, and a mesh that lies elsewhere in its own space (MeshPlace) has a node of its own below its node's.
/// `cameras` as load_cameras() gave them, `places` as load_meshes() did.
/// Returns which of scene.nodes each glTF node became; kNone for those that the scene does not reach.
std::vector<std::int32_t> load_nodes(Document& document, const std::vector<std::int32_t>& cameras,
                                     const std::vector<MeshPlace>& places, SceneData& scene);

struct Trs {
    glm::dvec3 translation_m{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};

glm::dmat4 matrix_of(const Trs& trs);

/// translation * rotation * scale with a mirror as one negative scale; none if the matrix shears. Throws Failure if its
/// columns are too long. Of the matrix's last row nothing is read.
std::optional<Trs> decompose(const glm::dmat4& matrix, const std::string& pointer);

/// Any affine matrix as matrix_of(outer) * mat4_cast(inner).
struct ShearedTrs {
    Trs outer;
    glm::dquat inner{1.0, 0.0, 0.0, 0.0};
};
ShearedTrs decompose_sheared(const glm::dmat4& matrix, const std::string& pointer);

/// Makes the last row 0 0 0 1, with a warning if rounding had moved it; throws Failure if the matrix is not affine.
void expect_affine(glm::dmat4& matrix, Document& document, const std::string& pointer);

}  // namespace gnomon::assets::gltf
