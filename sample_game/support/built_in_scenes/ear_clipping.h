#pragma once
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace gnomon::game {

/// Triangles (counter-clockwise, indices into `polygon`) of a simple counter-clockwise polygon without three points
/// in a row on one line, by clipping ears (Meisters 1975). O(n^3): for profiles of some dozen points.
/// A polygon that is not simple: the triangles found until no ear was left.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::dvec2> polygon);

}  // namespace gnomon::game
