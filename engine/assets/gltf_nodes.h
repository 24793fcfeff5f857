#pragma once
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/assets/gltf_document.h"
#include "engine/assets/scene_data.h"

namespace gnomon::assets::gltf {

/// Fills scene.nodes from the default scene (else the first scene, else all roots), depth first, parents before
/// children, and splits a light in two where its nodes disagree about its shadow. Needs meshes, cameras and lights.
/// A cycle, a second parent or a node too deep is an error, wherever in the file it stands.
/// Returns which of scene.nodes each glTF node became; kNone for those that the scene does not reach.
std::vector<std::int32_t> load_nodes(Document& document, SceneData& scene);

struct Trs {
    glm::dvec3 translation_m{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};

glm::dmat4 matrix_of(const Trs& trs);

/// translation * rotation * scale with a mirror as one negative scale. Throws Failure if the matrix is not affine or
/// shears.
Trs decompose(const glm::dmat4& matrix, const std::string& pointer);

}  // namespace gnomon::assets::gltf
