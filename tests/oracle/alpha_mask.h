#pragma once
#include <glm/vec2.hpp>

#include "gnomon/assets.h"

namespace gnomon::oracle {

/// Returns the alpha of a texture at `uv` (glTF: v down), 0…1, at its finest level. It is bilinear, or nearest if the
/// texture is set to it. A texture without texels is opaque.
double sample_alpha(const assets::Texture& texture, const glm::dvec2& uv);

/// Returns whether the material leaves the surface there at `uv`: it is not masked, or alpha * factor * vertex_alpha >=
/// cutoff.
bool passes_mask(const assets::MeshLibrary& library, const assets::Material& material, const glm::dvec2& uv,
                 double vertex_alpha = 1.0);

}  // namespace gnomon::oracle
