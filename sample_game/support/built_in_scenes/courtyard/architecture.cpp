#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "sample_game/support/built_in_scenes/courtyard/parts.h"

namespace gnomon::game {
namespace {

// Everything that stands reaches a little into the ground, as foundations do.
constexpr double kSunk_m = 0.1;

void add_ground(const Kit& kit) {
    constexpr double kHalf = 13.0, kThickness = 0.5;
    kit.place("ground", make_box({-kHalf, -kThickness, -kHalf}, {kHalf, 0.0, kHalf}), kit.materials.paving, {});
}

void add_walls(const Kit& kit) {
    const auto wall = [&](const char* name, const glm::dvec3& min, const glm::dvec3& max) {
        kit.place(name, make_box(min, max), kit.materials.plaster, {});
    };
    wall("wall_north", {-10.5, -kSunk_m, -10.5}, {10.5, 4.6, -10.0});
    wall("wall_west", {-10.5, -kSunk_m, -9.98}, {-10.0, 2.2, 10.5});
    wall("wall_east", {10.0, -kSunk_m, -9.98}, {10.5, 3.2, 4.0});
    // Merlons on the west wall.
    constexpr int kMerlons = 10;
    const std::uint32_t merlon =
        kit.glb.add_mesh("merlon", make_box({-0.25, -0.1, -0.5}, {0.25, 0.6, 0.5}), kit.materials.plaster);
    for (int i = 0; i < kMerlons; ++i) kit.place("merlon_" + std::to_string(i), merlon, {-10.25, 2.2, -9.0 + 2.0 * i});
}

/// Adds a wall with round arches, and columns under its piers.
void add_arcade(const Kit& kit) {
    constexpr int kArches = 5, kArchSteps = 16;
    constexpr double kPitch = 3.6, kOpening = 2.8, kSpring = 2.3, kTop = 4.6, kDepth = 0.5, kZ = -7.2;
    const double left = -0.5 * kPitch * kArches, radius = 0.5 * kOpening;
    std::vector<glm::dvec2> profile;
    const double first = left - 0.5 * (kPitch - kOpening), last = -first;
    profile.emplace_back(first, kSpring);
    for (int arch = 0; arch < kArches; ++arch) {
        const double centre = left + kPitch * (arch + 0.5);
        for (int step = 0; step <= kArchSteps; ++step) {
            const double angle = glm::pi<double>() * (1.0 - static_cast<double>(step) / kArchSteps);
            const bool end = step == 0 || step == kArchSteps;
            profile.emplace_back(centre + radius * std::cos(angle), kSpring + (end ? 0.0 : radius * std::sin(angle)));
        }
    }
    profile.emplace_back(last, kSpring);
    profile.emplace_back(last, kTop);
    profile.emplace_back(first, kTop);
    kit.place("arcade", make_extrusion(profile, kDepth), kit.materials.plaster, {0.0, 0.0, kZ});
    kit.place("arcade_roof", make_box({first, kTop - 0.05, -10.2}, {last, kTop + 0.15, kZ + 0.5}), kit.materials.wood,
              {});

    const std::array<glm::dvec2, 10> outline{glm::dvec2(0.0, -kSunk_m),
                                             {0.36, -kSunk_m},
                                             {0.36, 0.18},
                                             {0.26, 0.26},
                                             {0.24, 1.2},
                                             {0.2, kSpring - 0.3},
                                             {0.24, kSpring - 0.24},
                                             {0.34, kSpring - 0.1},
                                             {0.34, kSpring + 0.02},
                                             {0.0, kSpring + 0.02}};
    const std::uint32_t column =
        kit.glb.add_mesh("column", make_lathe(outline, 24, LatheNormals::creased), kit.materials.stone);
    for (int i = 0; i <= kArches; ++i) kit.place("column_" + std::to_string(i), column, {left + kPitch * i, 0.0, kZ});
}

void add_stairs(const Kit& kit) {
    constexpr int kSteps = 8;
    constexpr double kRise = 0.18, kRun = 0.3, kWidth = 2.4, kLanding = 2.2;
    std::vector<glm::dvec2> profile{
        {0.0, -kSunk_m}, {kSteps * kRun + kLanding, -kSunk_m}, {kSteps * kRun + kLanding, kSteps * kRise}};
    for (int step = kSteps; step >= 1; --step) {
        profile.emplace_back((step - 1) * kRun, step * kRise);
        if (step > 1) profile.emplace_back((step - 1) * kRun, (step - 1) * kRise);
    }
    kit.place("stairs", make_extrusion(profile, kWidth), kit.materials.stone, {5.3, 0.0, -3.4});

    // A handrail of thin bars along the landing.
    constexpr double kHeight = 0.95, kPost = 0.018;
    Shape rail;
    for (int i = 0; i <= 10; ++i) {
        const double x = 7.75 + 0.21 * i;
        append(rail, make_bar({x, kSteps * kRise - 0.05, -2.3}, {x, kSteps * kRise + kHeight, -2.3}, kPost, 8));
    }
    append(rail, make_bar({7.65, kSteps * kRise + kHeight, -2.3}, {9.95, kSteps * kRise + kHeight, -2.3}, 0.03, 10));
    kit.place("handrail", rail, kit.materials.iron, {});
}

/// Wires of 1 and 2 cm: the hard case of every shadow map.
void add_fence(const Kit& kit) {
    constexpr double kLength = 6.0, kHeight = 1.3, kWire = 0.005, kPicket = 0.01, kPost = 0.05;
    constexpr int kPickets = 40, kWires = 5, kPosts = 4;
    Shape pickets, wires, posts;
    for (int i = 0; i <= kPickets; ++i) {
        const double x = kLength * i / kPickets;
        append(pickets, make_bar({x, 0.06, 0.0}, {x, kHeight, 0.0}, kPicket, 6));
    }
    for (int i = 0; i < kWires; ++i) {
        const double y = 0.15 + (kHeight - 0.25) * i / (kWires - 1);
        append(wires, make_bar({-0.1, y, 0.0}, {kLength + 0.1, y, 0.0}, kWire, 6));
    }
    for (int i = 0; i < kPosts; ++i) {
        const double x = -0.1 + (kLength + 0.2) * i / (kPosts - 1);
        append(posts, make_box({x - kPost, -kSunk_m, -kPost}, {x + kPost, kHeight + 0.15, kPost}));
    }
    const glm::dvec3 at(-6.4, 0.0, 4.2);
    const glm::dquat turn = turned(9.0);
    kit.place("fence_pickets", pickets, kit.materials.iron, at, turn);
    kit.place("fence_wires", wires, kit.materials.iron, at, turn);
    kit.place("fence_posts", posts, kit.materials.wood, at, turn);
}

}  // namespace

void add_architecture(const Kit& kit) {
    add_ground(kit);
    add_walls(kit);
    add_arcade(kit);
    add_stairs(kit);
    add_fence(kit);
}

}  // namespace gnomon::game
