#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::game {

struct Spheres {
    std::vector<std::byte> glb;
    std::uint64_t triangles = 0;  // over all nodes
};

/// A scene of 60 000 triangles as binary glTF, to measure by: a field of finely cut spheres, sunk into each other and
/// into the ground, and thin rings standing among them, under a sun alone; camera "main". Same bytes every time.
Spheres make_spheres();

}  // namespace gnomon::game
