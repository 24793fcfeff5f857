#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "sample_game/support/built_in_scenes/courtyard/parts.h"
#include "sample_game/support/built_in_scenes/tree_crown.h"

namespace gnomon::game {
namespace {

constexpr double kSunk_m = 0.1;

void add_tree(const Kit& kit) {
    constexpr double kGoldenAngle = 2.399963229728653;
    const std::array<glm::dvec2, 6> trunk{
        glm::dvec2(0.0, -kSunk_m), {0.26, -kSunk_m}, {0.17, 0.25}, {0.13, 1.6}, {0.07, 2.9}, {0.0, 2.95}};
    Shape bark = make_lathe(trunk, 12, LatheNormals::smooth);
    for (int i = 0; i < 6; ++i) {
        const double angle = kGoldenAngle * i, y = 1.5 + 0.2 * i;
        append(bark, make_bar({0.0, y, 0.0}, {0.9 * std::cos(angle), y + 0.7, 0.9 * std::sin(angle)}, 0.035, 6));
    }
    const Shape crown = make_tree_crown({.radius_m = 1.35, .card_m = 0.95, .height_m = 3.1, .cards = 72});
    const glm::dvec3 at(-6.3, 0.0, -2.6);
    kit.place("tree_trunk", bark, kit.materials.bark, at);
    kit.place("tree_crown", crown, kit.materials.leaves, at);
}

void add_cloth(const Kit& kit) {
    kit.place("cloth", make_cloth(2.2, 1.5, 0.12, 2.0, 24, 12), kit.materials.cloth, {3.4, 2.28, -4.6}, turned(-14.0));
    Shape line;
    append(line, make_bar({-1.5, 0.0, 0.0}, {1.5, 0.0, 0.0}, 0.01, 6));
    for (const double x : {-1.5, 1.5}) append(line, make_bar({x, -2.28 - kSunk_m, 0.0}, {x, 0.1, 0.0}, 0.03, 8));
    kit.place("cloth_line", line, kit.materials.iron, {3.4, 2.28, -4.6}, turned(-14.0));
}

void add_things(const Kit& kit) {
    const std::uint32_t crate =
        kit.glb.add_mesh("crate", make_box({-0.45, -0.02, -0.45}, {0.45, 0.88, 0.45}), kit.materials.wood);
    kit.place("crate_a", crate, {-3.9, 0.0, -3.6}, turned(17.0));
    kit.place("crate_b", crate, {-2.8, 0.0, -4.0}, turned(-8.0));
    kit.place("crate_c", crate, {-3.4, 0.9, -3.8}, turned(38.0));
    const std::array<glm::dvec2, 8> barrel{glm::dvec2(0.0, -0.02), {0.3, -0.02}, {0.37, 0.25}, {0.4, 0.5},
                                           {0.37, 0.75},           {0.3, 1.0},   {0.27, 1.0},  {0.0, 0.96}};
    const std::uint32_t barrel_mesh =
        kit.glb.add_mesh("barrel", make_lathe(barrel, 20, LatheNormals::creased), kit.materials.wood);
    kit.place("barrel_a", barrel_mesh, {0.5, 0.0, -2.6});
    kit.place("barrel_b", barrel_mesh, {1.4, 0.0, -3.1});

    const std::array<glm::dvec2, 8> pedestal{glm::dvec2(0.0, -kSunk_m),
                                             {0.5, -kSunk_m},
                                             {0.5, 0.15},
                                             {0.34, 0.22},
                                             {0.34, 0.8},
                                             {0.46, 0.88},
                                             {0.46, 1.0},
                                             {0.0, 1.0}};
    kit.place("pedestal", make_lathe(pedestal, 8, LatheNormals::creased), kit.materials.stone, {-3.4, 0.0, 1.4});
    kit.place("pedestal_ball", make_sphere(0.45, 32, 16), kit.materials.red, {-3.4, 1.44, 1.4});
    kit.place("ball", make_sphere(0.3, 24, 12), kit.materials.blue, {0.3, 0.29, 3.6});

    // A plant pot with an open bowl: thin walls, seen from both sides.
    const std::array<glm::dvec2, 7> pot{
        glm::dvec2(0.0, -0.02), {0.22, -0.02}, {0.36, 0.55}, {0.4, 0.6}, {0.37, 0.6}, {0.2, 0.06}, {0.0, 0.06}};
    kit.place("pot", make_lathe(pot, 24, LatheNormals::creased), kit.materials.red, {6.6, 0.0, 1.9});
}

void add_movers(const Kit& kit) {
    const std::uint32_t turnstile =
        kit.mover("turnstile", {4.2, 0.0, 0.8}, {{"kind", "spin"}, {"axis", {0, 1, 0}}, {"period_s", 12.0}});
    Shape arms;
    append(arms, make_bar({0.0, -0.05, 0.0}, {0.0, 1.5, 0.0}, 0.09, 12));
    for (const double y : {0.7, 1.3}) {
        append(arms, make_box({-1.0, y, -0.035}, {1.0, y + 0.07, 0.035}));
        append(arms, make_box({-0.035, y + 0.1, -1.0}, {0.035, y + 0.17, 1.0}));
    }
    kit.place("turnstile_arms", arms, kit.materials.blue, {}, {1.0, 0.0, 0.0, 0.0}, turnstile);

    const std::uint32_t cart =
        kit.mover("cart", {1.6, 0.0, 5.6},
                  {{"kind", "slide"}, {"axis", {1, 0, 0}}, {"amplitude", 1.6}, {"period_s", 9.0}}, turned(12.0));
    kit.place("cart_box", make_box({-0.6, 0.3, -0.4}, {0.6, 0.85, 0.4}), kit.materials.red, {}, {1.0, 0.0, 0.0, 0.0},
              cart);
    Shape wheels;
    for (const double x : {-0.4, 0.4})
        for (const double z : {-0.47, 0.41}) append(wheels, make_bar({x, 0.25, z}, {x, 0.25, z + 0.06}, 0.25, 20));
    kit.place("cart_wheels", wheels, kit.materials.iron, {}, {1.0, 0.0, 0.0, 0.0}, cart);

    const std::uint32_t sign = kit.mover(
        "sign", {7.0, 2.35, 4.6}, {{"kind", "swing"}, {"axis", {1, 0, 0}}, {"amplitude", 0.35}, {"period_s", 2.6}});
    kit.place("sign_board", make_box({-0.45, -0.75, -0.02}, {0.45, -0.1, 0.02}), kit.materials.blue, {},
              {1.0, 0.0, 0.0, 0.0}, sign);
    Shape frame;
    for (const double x : {-0.6, 0.6}) append(frame, make_bar({x, -2.35 - kSunk_m, 0.0}, {x, 0.05, 0.0}, 0.04, 8));
    append(frame, make_bar({-0.65, 0.0, 0.0}, {0.65, 0.0, 0.0}, 0.03, 8));
    kit.place("sign_frame", frame, kit.materials.wood, {7.0, 2.35, 4.6});

    const std::uint32_t carousel = kit.mover(
        "carousel", {-3.4, 2.2, 1.4}, {{"kind", "spin"}, {"axis", {0.1, 1, 0}}, {"period_s", 7.0}, {"phase", 0.2}});
    const std::uint32_t moon = kit.glb.add_mesh("moon", make_sphere(0.14, 16, 8), kit.materials.brass);
    for (int i = 0; i < 3; ++i) {
        const double angle = 2.0 * glm::pi<double>() * i / 3.0;
        kit.place("moon_" + std::to_string(i), moon, {0.85 * std::cos(angle), 0.12 * i, 0.85 * std::sin(angle)},
                  {1.0, 0.0, 0.0, 0.0}, carousel);
    }
}

}  // namespace

void add_furniture(const Kit& kit) {
    add_tree(kit);
    add_cloth(kit);
    add_things(kit);
    add_movers(kit);
}

}  // namespace gnomon::game
