#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gnomon/assets.h"
#include "systems/extract/snapshot.h"
#include "systems/truth/tint_truth.h"
#include "tests/oracle/reference_tracer.h"

/// Ray-traced truth about what translucent casters let through.
namespace gnomon::oracle {

/// Returns the share of light that passes through a surface of that material, per channel, in double. `uv`: its place
/// in the texture. `vertex_colour`: interpolated there.
glm::dvec3 surface_transmittance(const assets::MeshLibrary& library, const assets::Material& material,
                                 const glm::dvec2& uv, const glm::dvec4& vertex_colour);

/// Returns for each pixel the product over all translucent surfaces between the seen surface and the light. Every
/// crossed triangle counts once, an edge between two of them as one of both. 1: no surface, or none in the way.
/// It tries every triangle, so that it suits small scenes. `origin_ws_m`: the tracer's that found `hits`.
std::vector<glm::dvec3> trace_tint(const SceneSnapshot& scene, const assets::MeshLibrary& library,
                                   const glm::dvec3& origin_ws_m, const PrimaryHits& hits, const LightItem& light);

/// Returns whether any caster of the light lets light through.
bool has_translucent_casters(const SceneSnapshot& scene, const assets::MeshLibrary& library, const LightItem& light);

/// The library's figures, by the oracle's truth, over all pixels with a surface.
struct TintMetrics : truth::TintMetrics {
    glm::dvec3 darkest{1.0};  // truth, each channel by itself
};

/// Compares `measured`, values as Frame::read_tint() has them, of the size of the hits, with the truth.
TintMetrics compare_tint(const PrimaryHits& hits, std::span<const glm::dvec3> truth,
                         std::span<const glm::vec4> measured);

}  // namespace gnomon::oracle
