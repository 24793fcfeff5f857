#pragma once
#include "gnomon/box.h"
#include "gnomon/registry.h"

namespace gnomon::game {

/// Largest share of light that mist may take per metre.
inline constexpr float kMostMist_per_m = 10.0f;

/// Sets the mist in all of a scene within these bounds: a FogVolume of white droplets. `mist`: its entity, kNull: none.
/// Adds it above 0 per metre, removes it at 0. Nothing for empty bounds.
void set_mist(const math::Aabb& bounds_ws, float extinction_per_m, ecs::Entity& mist, ecs::Registry& registry);

}  // namespace gnomon::game
