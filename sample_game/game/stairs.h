#pragma once
#include <vector>

#include "gnomon/assets.h"
#include "sample_game/game/collision_boxes.h"

namespace gnomon::game {

/// Returns a box per tread of a flight of stairs, lowest first; empty if the mesh has none. A tread is made of the
/// faces at one height that look straight up. Its box fills the rectangle around them, from the bottom of `mesh` to
/// there.
std::vector<Solid> treads_of(const assets::Mesh& mesh, std::size_t node);

}  // namespace gnomon::game
