#pragma once
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "engine/assets/gltf_mesh.h"
#include "gnomon/assets.h"

namespace gnomon::assets::gltf {

/// Fills scene.nodes from the default scene (otherwise the first scene, otherwise all roots), depth first, parents
/// before children. Needs meshes, cameras and lights; `cameras` from load_cameras(), `places` from load_meshes().
/// Splits a light in two if its nodes disagree about its shadow. A cycle, a second parent or excessive depth is an
/// error anywhere in the file. A node with shear becomes two. A mesh with a MeshPlace gets a node of its own below its
/// node. Returns for each glTF node its index in scene.nodes; kNone if the scene does not contain it.
std::vector<std::int32_t> load_nodes(Document& document, const std::vector<std::int32_t>& cameras,
                                     const std::vector<MeshPlace>& places, SceneData& scene);

struct Trs {
    glm::dvec3 translation_m{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};

glm::dmat4 matrix_of(const Trs& trs);

/// Decomposes into translation * rotation * scale, with a mirror as one negative scale. Returns nothing if the matrix
/// has shear. Throws Failure if its columns are too long. Ignores the last row.
std::optional<Trs> decompose(const glm::dmat4& matrix, const std::string& pointer);

/// Decomposition of any affine matrix: matrix_of(outer) * mat4_cast(inner).
struct ShearedTrs {
    Trs outer;
    glm::dquat inner{1.0, 0.0, 0.0, 0.0};
};
ShearedTrs decompose_sheared(const glm::dmat4& matrix, const std::string& pointer);

/// Sets the last row to 0 0 0 1, with a warning if rounding had changed it. Throws Failure if the matrix is not affine.
void expect_affine(glm::dmat4& matrix, Document& document, const std::string& pointer);

}  // namespace gnomon::assets::gltf
