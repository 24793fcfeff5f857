#include "sample_game/gui/keys.h"

#include <algorithm>

namespace gnomon::game {
namespace {

constexpr KeyRow kKeys[] = {
    {KeyPlace::shadows, "F5", "", "freeze the frame and mark every pixel that ray-traced truth calls wrong"},
    {KeyPlace::shadows, "F1", "", "lights: what each shadow costs, how exact it is, and all settings"},
    {KeyPlace::shadows, "F3", "", "next debug view: cascades, texels, bias, frusta ..."},
    {KeyPlace::shadows, "F2", "", "the same view of the next light; after F5 the next light's errors"},
    {KeyPlace::shadows, "F4", "", "freeze the maps' fits while the camera goes on"},
    {KeyPlace::shadows, "F6", "", "smooth edges and samples of a still picture: off and on"},
    {KeyPlace::shadows, "P", "start", "pause"},
    {KeyPlace::shadows, "W A S D", "left stick", "walk"},
    {KeyPlace::shadows, "Shift", "right trigger, bumpers", "walk faster"},
    {KeyPlace::shadows, "mouse", "right stick", "click to look around, Tab to free it"},
    {KeyPlace::shadows, "Esc", "", "quit"},
    {KeyPlace::game, "R", "back", "restart"},
    {KeyPlace::game, "Left, Right", "cross, left and right", "move the sun"},
    {KeyPlace::scene, "Q, E", "", "fly down, up"},
};

}  // namespace

std::span<const KeyRow> key_table() { return kKeys; }

std::string list_keys() {
    constexpr std::size_t kWidth = 14;
    std::string text = "Keys in the window:\n";
    for (const KeyRow& row : kKeys) {
        std::string keys = row.keys;
        keys.resize(std::max(kWidth, keys.size() + 1), ' ');
        text += "  " + keys + row.meaning;
        if (row.place == KeyPlace::game) text += " (the game)";
        if (row.place == KeyPlace::scene) text += " (without the game)";
        text += "\n";
    }
    return text;
}

}  // namespace gnomon::game
