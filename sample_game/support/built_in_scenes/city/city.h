#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::game {

struct CityOptions {
    int blocks = 50;  // along each side, from 1 on: 80 m and 42 things each
};

struct City {
    std::vector<std::byte> glb;
    std::uint64_t triangles = 0;  // over all nodes
};

/// Makes a city of 4 km as binary glTF: 105 000 houses, trees, posts, parked cars and people, and 156 things that move.
/// Light: a low sun, 276 street lamps around the middle, and the headlamps of 24 moving cars. Cameras: "street", "roof"
/// and "air" stand; "walk", "drive" and "fly" move. Same bytes every time.
City make_city(const CityOptions& options = {});

}  // namespace gnomon::game
