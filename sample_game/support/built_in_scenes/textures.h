#pragma once
#include <cstdint>
#include <vector>

/// Pictures of the built-in scene as PNG files in memory, computed, the same on every machine.
namespace gnomon::game {

std::vector<std::uint8_t> leaf_texture_png();    // RGBA; alpha cuts out leaves
std::vector<std::uint8_t> cloth_texture_png();   // RGBA; alpha cuts out a row of holes and a torn hem
std::vector<std::uint8_t> paving_texture_png();  // opaque stone slabs, tiles

}  // namespace gnomon::game
