#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace gnomon::game {

/// Returns the counter-clockwise triangles of a polygon as indices into it, by clipping ears (Meisters 1975). The
/// polygon is simple and counter-clockwise, without three points in a row on one line. Otherwise the result has the
/// triangles found until no ear was left. O(n^3): for profiles of some dozen points.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::dvec2> polygon);

}  // namespace gnomon::game
