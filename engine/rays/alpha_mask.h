#pragma once
#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/assets/mesh_library.h"

namespace gnomon::rays {

/// Whether a masked material is there at a point of a triangle, at the texture's finest level, as the picture has it:
/// alpha of colour, texture and vertices' colours at least the cutoff, filtered and wrapped as the texture says. True
/// of opaque ones, and where texture coordinates are not finite the texture counts as 1. `weights`: of the three
/// corners.
bool is_there(const assets::MeshLibrary& library, const assets::Mesh& mesh, std::uint32_t triangle,
              std::uint32_t material, const glm::dvec3& weights);

}  // namespace gnomon::rays
