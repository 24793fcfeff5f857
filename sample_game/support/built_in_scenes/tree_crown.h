#pragma once
#include "sample_game/support/built_in_scenes/primitives.h"

namespace gnomon::game {

struct TreeCrown {
    double radius_m, card_m, height_m;  // crown's radius; edge of a card; height of the crown's middle
    int cards;
};

/// Makes cards of leaves on a Fibonacci sphere, each turned its own way; open.
Shape make_tree_crown(const TreeCrown& crown);

}  // namespace gnomon::game
