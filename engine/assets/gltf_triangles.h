#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::assets::gltf {

/// Triangles that `corners` corners make in a glTF mode (4 list, 5 strip, 6 fan); a last incomplete one is dropped.
std::size_t triangle_count(int mode, std::size_t corners);

/// Appends the triangles as a list, keeping the winding of glTF 2.0 section 3.7.2.1. `corners` empty: 0, 1, 2, …
/// `first_vertex` is added to every index.
void append_triangles(int mode, const std::vector<std::uint32_t>& corners, std::size_t corner_count,
                      std::uint32_t first_vertex, std::vector<std::uint32_t>& indices);

}  // namespace gnomon::assets::gltf
