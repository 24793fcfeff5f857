#pragma once
#include <cstdint>
#include <glm/vec3.hpp>

#include "gnomon/assets.h"

/// What passes through a surface at a point of a triangle, by its colour: material, texture and vertex colour in
/// product. The texture is read at its finest level, with its own filter and wrapping. Texture coordinates that are not
/// finite read 1. `weights`: barycentric, of the three corners.
namespace gnomon::rays {

/// Returns true if a masked material is present, as the picture shows it: where the alpha is at least the cutoff.
/// Opaque materials are always present.
bool is_there(const assets::MeshLibrary& library, const assets::Mesh& mesh, std::uint32_t triangle,
              std::uint32_t material, const glm::dvec3& weights);

/// Returns the share of light that a translucent material lets through, per channel, 0 to 1. Holes of a mask let all
/// through. GLSL twin: shaders/shadow/passes/tint/surface_transmittance.glsl.
glm::dvec3 transmittance(const assets::MeshLibrary& library, const assets::Mesh& mesh, std::uint32_t triangle,
                         std::uint32_t material, const glm::dvec3& weights);

}  // namespace gnomon::rays
