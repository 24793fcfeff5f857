#pragma once
#include <cstdint>

#include "engine/assets/scene_data.h"

namespace gnomon::bench {

inline constexpr std::uint32_t kMostShadowedLights = 200;  // what one scene is asked to bear
inline constexpr const char* kDemandMover = "mover";       // the node that moves, if any does

/// A box as an importer leaves it, of material 0.
assets::Mesh box_mesh(const char* name, const glm::dvec3& min, const glm::dvec3& max);

/// A level of 120 m by 120 m: 100 tiles of ground, 400 columns and blocks on it, one of them the mover, and a camera in
/// the midst at the height of eyes. Light 0 is a sun; points and spots follow in turn, 4 to 6 m of range each, spread
/// over the level so that every number of them lies as evenly; the first kMostShadowedLights cast shadows. The same
/// seed gives the same level, and fewer lights are the first of more. `lights` may be 0: then there is none.
assets::SceneData demand_scene(std::uint32_t lights, std::uint64_t seed);

}  // namespace gnomon::bench
