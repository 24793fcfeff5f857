#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::game {

struct Spheres {
    std::vector<std::byte> glb;
    std::uint64_t triangles = 0;  // over all nodes
};

/// Makes a scene of 60 000 triangles as binary glTF, for measurements. Finely cut spheres sink into each other and into
/// the ground; thin rings stand among them. Light: a sun alone. Camera: "main". Same bytes every time.
Spheres make_spheres();

}  // namespace gnomon::game
