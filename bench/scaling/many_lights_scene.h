#pragma once
#include <cstdint>

#include "gnomon/assets.h"

namespace gnomon::bench {

inline constexpr std::uint32_t kMostShadowedLights = 200;  // most lights with shadows in one scene
inline constexpr const char* kDemandMover = "mover";       // the node that moves, if any does

/// Makes a box as an importer leaves it, with material 0.
assets::Mesh box_mesh(const char* name, const glm::dvec3& min, const glm::dvec3& max);

/// Makes a level of 120 m by 120 m: 100 tiles of ground with 400 columns and blocks, one of them the mover. A camera
/// stands in its middle at eye height. Light 0 is a sun; points and spots of 4 to 6 m range follow in turn. Any number
/// of them is spread evenly. The first kMostShadowedLights cast shadows. The same seed gives the same level, and fewer
/// lights are the first of more. `lights` may be 0.
assets::SceneData demand_scene(std::uint32_t lights, std::uint64_t seed);

}  // namespace gnomon::bench
