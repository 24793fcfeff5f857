#include "sample_game/support/built_in_scenes/tree_crown.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace gnomon::game {

Shape make_tree_crown(const TreeCrown& crown) {
    constexpr double kGoldenAngle = 2.399963229728653;
    Shape shape;
    for (int i = 0; i < crown.cards; ++i) {
        const double height = 1.0 - 2.0 * (i + 0.5) / crown.cards, ring = std::sqrt(1.0 - height * height);
        const double angle = kGoldenAngle * i, shell = crown.radius_m * (0.55 + 0.45 * (i % 3) / 2.0);
        const glm::dvec3 centre(shell * ring * std::cos(angle), crown.height_m + 0.8 * shell * height,
                                shell * ring * std::sin(angle));
        const glm::dvec3 right(std::cos(1.7 * angle), 0.25 * std::sin(angle), std::sin(1.7 * angle));
        const glm::dvec3 up(0.35 * std::cos(2.3 * angle), 1.0, 0.35 * std::sin(2.3 * angle));
        append(shape, make_card(centre, crown.card_m * glm::normalize(right), crown.card_m * glm::normalize(up)));
    }
    return shape;
}

}  // namespace gnomon::game
