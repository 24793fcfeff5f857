#pragma once
#include <cstdint>
#include <vector>

#include "gnomon/assets.h"

namespace gnomon::assets {

/// Returns for each vertex the number of its welded vertex, from 0 in order of first appearance. Vertices with bitwise
/// equal positions share a number (-0 equals +0).
std::vector<std::uint32_t> weld_by_position(const std::vector<Vertex>& vertices);

}  // namespace gnomon::assets
