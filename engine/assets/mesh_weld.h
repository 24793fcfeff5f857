#pragma once
#include <cstdint>
#include <vector>

#include "engine/assets/scene_data.h"

namespace gnomon::assets {

/// For each vertex the number of its welded vertex: equal for identical position bits (-0 and +0 are the same),
/// counted from 0 in order of first appearance.
std::vector<std::uint32_t> weld_by_position(const std::vector<Vertex>& vertices);

}  // namespace gnomon::assets
