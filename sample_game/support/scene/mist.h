#pragma once
#include "gnomon/box.h"
#include "gnomon/registry.h"

namespace gnomon::game {

/// Largest share of light that mist may take per metre.
inline constexpr float kMostMist_per_m = 10.0f;

/// Adds mist to all of a scene within these bounds: a FogVolume of white droplets. Nothing for empty bounds.
void add_mist(const math::Aabb& bounds_ws, float extinction_per_m, ecs::Registry& registry);

}  // namespace gnomon::game
