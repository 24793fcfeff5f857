#pragma once
#include <vector>

#include "engine/assets/scene_data.h"
#include "sample_game/game/collision_boxes.h"

namespace gnomon::game {

/// One solid per tread of a flight of stairs, lowest first: each box stands at the bottom of `mesh` and ends at a
/// height at which the mesh has faces that look straight up, over the rectangle around these. Empty if there are none.
std::vector<Solid> treads_of(const assets::Mesh& mesh, std::size_t node);

}  // namespace gnomon::game
