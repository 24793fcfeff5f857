#pragma once
#include <cstdint>
#include <glm/vec3.hpp>

#include "gnomon/assets.h"

namespace gnomon::rays {

/// Returns true if a masked material is present at a point of a triangle, as the picture shows it. That is where the
/// product of colour, texture and vertex colour has an alpha of at least the cutoff. The texture is read at its finest
/// level, with its own filter and wrapping. Opaque materials are always present. Texture coordinates that are not
/// finite read 1. `weights`: barycentric, of the three corners.
bool is_there(const assets::MeshLibrary& library, const assets::Mesh& mesh, std::uint32_t triangle,
              std::uint32_t material, const glm::dvec3& weights);

}  // namespace gnomon::rays
