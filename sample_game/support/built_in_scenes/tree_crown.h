#pragma once
#include "sample_game/support/built_in_scenes/primitives.h"

namespace gnomon::game {

struct TreeCrown {
    double radius_m, card_m, height_m;  // of the crown; edge of a card; of the crown's middle above the ground
    int cards;
};

/// Open: cards of leaves on a Fibonacci sphere, each turned its own way.
Shape make_tree_crown(const TreeCrown& crown);

}  // namespace gnomon::game
