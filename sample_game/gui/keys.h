#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>

/// Keys of the window: the first screen, --help and the pages show this table.
namespace gnomon::game {

/// Part of the program in which a key works.
enum class KeyPlace : std::uint8_t {
    shadows,  // everywhere
    game,     // while the game is played
    scene     // while a scene is looked at
};
inline constexpr std::array<const char*, 3> kKeyPlaces{"look at the shadows", "the game", "a scene without the game"};

struct KeyRow {
    KeyPlace place;
    const char* keys;
    const char* gamepad;  // the same on a gamepad; empty: nothing
    const char* meaning;  // one line
};
/// Returns all keys, first the keys that show shadows.
std::span<const KeyRow> key_table();

/// Returns the keys as --help prints them.
std::string list_keys();

}  // namespace gnomon::game
