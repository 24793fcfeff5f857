#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/assets.h"
#include "systems/extract/snapshot.h"
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

}  // namespace gnomon::oracle
