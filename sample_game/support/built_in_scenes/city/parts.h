#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <random>
#include <string>
#include <vector>

#include "sample_game/support/built_in_scenes/city/city.h"
#include "sample_game/support/built_in_scenes/glb_writer.h"

/// Builders, materials and meshes that the parts of the city share.
namespace gnomon::game {

struct CityMeshes {
    std::uint32_t slab, street, leaf_tree, conifer, post, bench, bin, person;
    std::array<std::uint32_t, 6> houses;
    std::array<std::uint32_t, 3> cars;
};

struct CityKit {
    GlbBuilder& glb;
    CityOptions options;
    CityMeshes meshes;
    std::mt19937& random;

    /// Returns a number below `bound`, by bits alone: standard distributions differ between libraries.
    std::uint32_t below(std::uint32_t bound) const { return static_cast<std::uint32_t>(random() % bound); }
    /// Returns a place between -half and half, on a grid of 1/16.
    double about(double half) const { return half * (static_cast<double>(below(33)) / 16.0 - 1.0); }

    std::uint32_t place(const std::string& name, std::uint32_t mesh, const glm::dvec3& at_m, double turn_deg) const;
    /// Returns the middle of a block. The origin is in the middle block of the city.
    glm::dvec3 middle_m(int column, int row) const;
};

CityMeshes add_city_meshes(GlbBuilder& glb);
void add_blocks(const CityKit& kit);   // what stands, and its lamps
void add_traffic(const CityKit& kit);  // cars that drive, people that walk, cameras that do

/// Pitch of the streets, metres. Their middles are half of it from those of the blocks.
inline constexpr double kBlock_m = 80.0;
/// Height of the slabs that blocks stand on.
inline constexpr double kCurb_m = 0.14;
/// Height of a street lamp's light, metres, and its reach over the street.
inline constexpr double kLamp_m = 6.4, kLampArm_m = 1.6;

}  // namespace gnomon::game
