#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "sample_game/support/built_in_scenes/courtyard/parts.h"

namespace gnomon::game {
namespace {

constexpr double kSunk_m = 0.1;

/// Adds a cloaked walker, feet at the origin, looking along -Z.
void add_player(const Kit& kit) {
    const std::array<glm::dvec2, 9> cloak{glm::dvec2(0.0, 0.02), {0.24, 0.02}, {0.29, 0.1},  {0.25, 0.7}, {0.2, 1.05},
                                          {0.23, 1.32},          {0.16, 1.45}, {0.07, 1.52}, {0.0, 1.54}};
    const std::array<glm::dvec2, 5> hat{glm::dvec2(0.0, 1.68), {0.27, 1.68}, {0.27, 1.7}, {0.12, 1.73}, {0.0, 1.92}};
    Shape body = make_lathe(cloak, 20, LatheNormals::smooth);
    append(body, make_sphere(0.13, 20, 10), glm::translate(glm::dmat4(1.0), {0.0, 1.6, 0.0}));
    append(body, make_lathe(hat, 20, LatheNormals::creased));
    append(body, make_bar({-0.05, 1.3, -0.12}, {-0.05, 0.55, -0.34}, 0.02, 6));  // a staff marks the front
    kit.place("player", body, kit.materials.blue, {-8.2, 0.0, 9.6}, turned(-90.0));
}

/// Adds a screen that hides the player: boards on two posts, facing the guard lamp.
void add_screen(const Kit& kit, const std::string& name, const glm::dvec3& at, double degrees) {
    constexpr double kHalfWidth = 1.0, kTop = 2.4, kHalfThick = 0.05;
    constexpr int kBoards = 8;
    constexpr double kOverlap = 0.02, kBoard = 2.0 * kHalfWidth / kBoards;  // a gap would give the player away
    Shape boards;
    for (int i = 0; i < kBoards; ++i) {
        const double x = -kHalfWidth + kBoard * i, z = 0.03 * (i % 2);
        append(boards,
               make_box({x, 0.05, z - kHalfThick}, {x + kBoard + kOverlap, kTop - 0.04 * (i % 2), z + kHalfThick}));
    }
    for (const double x : {-0.9, 0.8})
        append(boards, make_box({x, -kSunk_m, kHalfThick + 0.02}, {x + 0.1, kTop + 0.1, kHalfThick + 0.12}));
    kit.place(name, boards, kit.materials.wood, at, turned(degrees));
}

void add_gate(const Kit& kit) {
    const std::uint32_t post =
        kit.glb.add_mesh("gate_post", make_box({-0.2, -kSunk_m, -0.2}, {0.2, 2.6, 0.2}), kit.materials.stone);
    kit.place("gate_post_n", post, {10.15, 0.0, 8.0});
    kit.place("gate_post_s", post, {10.15, 0.0, 10.5});
    Shape lintel;
    append(lintel, make_box({-0.22, 2.6, -1.5}, {0.22, 2.85, 1.5}));
    kit.place("gate_lintel", lintel, kit.materials.stone, {10.15, 0.0, 9.25});
    Shape lamps;
    for (const double z : {-1.25, 1.25})
        append(lamps, make_sphere(0.1, 16, 8), glm::translate(glm::dmat4(1.0), {0.0, 3.0, z}));
    kit.place("gate_lamps", lamps, kit.materials.lamp_glow, {10.15, 0.0, 9.25});
}

}  // namespace

void add_game(const Kit& kit) {
    add_player(kit);
    add_screen(kit, "screen_a", {-0.9, 0.0, 8.2}, 74.0);
    add_screen(kit, "screen_b", {4.6, 0.0, 8.4}, 80.0);
    add_gate(kit);
    kit.place("parapet_s", make_box({-10.5, -kSunk_m, 10.5}, {10.3, 0.9, 10.8}), kit.materials.plaster, {});
    kit.place("parapet_e", make_box({10.0, -kSunk_m, 4.02}, {10.3, 0.9, 8.0}), kit.materials.plaster, {});
}

}  // namespace gnomon::game
