#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::assets::gltf {

/// Returns the number of triangles that `corners` corners form in a glTF mode (4 list, 5 strip, 6 fan). An incomplete
/// last one does not count.
std::size_t triangle_count(int mode, std::size_t corners);

/// Appends the triangles as a list, keeping the winding of glTF 2.0 section 3.7.2.1. Empty `corners` mean 0, 1, 2, …
/// Adds `first_vertex` to every index.
void append_triangles(int mode, const std::vector<std::uint32_t>& corners, std::size_t corner_count,
                      std::uint32_t first_vertex, std::vector<std::uint32_t>& indices);

}  // namespace gnomon::assets::gltf
