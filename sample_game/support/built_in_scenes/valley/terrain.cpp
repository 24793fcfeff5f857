#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "sample_game/support/built_in_scenes/valley/parts.h"

namespace gnomon::game {
namespace {

// Exact in binary, so that tiles meet without a gap: 16 by 16 of them, 12 squares along an edge.
constexpr int kTiles = 16, kSquares = 12;
constexpr double kSquare_m = 12.5, kTile_m = kSquares * kSquare_m;
constexpr double kWest_m = -0.5 * kTiles * kTile_m, kNorth_m = 300.0 - kTiles * kTile_m;

glm::vec3 normal_at(double x_m, double z_m) {
    const double rise_x = ground_height_m(x_m + 0.5, z_m) - ground_height_m(x_m - 0.5, z_m);
    const double rise_z = ground_height_m(x_m, z_m + 0.5) - ground_height_m(x_m, z_m - 0.5);
    return glm::vec3(glm::normalize(glm::dvec3(-rise_x, 1.0, -rise_z)));
}

/// Makes a tile of the ground, with coordinates about its middle.
Shape tile_at(const glm::dvec2& middle_m) {
    Shape tile;
    for (int row = 0; row <= kSquares; ++row)
        for (int column = 0; column <= kSquares; ++column) {
            const glm::dvec2 at_m = kSquare_m * glm::dvec2(column, row) - 0.5 * kTile_m;
            const glm::dvec2 world_m = middle_m + at_m;
            tile.positions.emplace_back(at_m.x, ground_height_m(world_m.x, world_m.y), at_m.y);
            tile.normals.push_back(normal_at(world_m.x, world_m.y));
            tile.uvs.emplace_back(at_m);
        }
    for (std::uint32_t row = 0; row < kSquares; ++row)
        for (std::uint32_t column = 0; column < kSquares; ++column) {
            const std::uint32_t a = row * (kSquares + 1) + column, b = a + 1, c = a + kSquares + 1, d = c + 1;
            tile.indices.insert(tile.indices.end(), {a, c, d, a, d, b});
        }
    return tile;
}

}  // namespace

double ground_height_m(double x_m, double z_m) {
    const double away_m = std::hypot(x_m, z_m + 70.0);
    const double hills = 14.0 * std::sin(x_m / 97.0 + 0.7) * std::cos(z_m / 121.0 - 0.4) +
                         26.0 * std::sin(x_m / 251.0 - z_m / 307.0) + 6.0 * std::cos(x_m / 43.0 + z_m / 59.0);
    const double ridge = 150.0 * glm::smoothstep(900.0, 2000.0, -z_m + 0.25 * std::abs(x_m));
    return hills * glm::smoothstep(110.0, 420.0, away_m) + ridge;
}

void add_valley_ground(const ValleyKit& kit) {
    for (int row = 0; row < kTiles; ++row)
        for (int column = 0; column < kTiles; ++column) {
            const std::string name = "ground_" + std::to_string(row) + "_" + std::to_string(column);
            const glm::dvec2 middle_m(kWest_m + (column + 0.5) * kTile_m, kNorth_m + (row + 0.5) * kTile_m);
            kit.glb.add_node({.name = name,
                              .translation_m = {middle_m.x, 0.0, middle_m.y},
                              .mesh = kit.glb.add_mesh(name, tile_at(middle_m), kit.materials.grass)});
        }
}

}  // namespace gnomon::game
