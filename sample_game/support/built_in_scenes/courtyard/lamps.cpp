#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <string_view>

#include "sample_game/support/built_in_scenes/courtyard/parts.h"

namespace gnomon::game {
namespace {

// Dusk: the lamps are about as bright on the ground as the sun, so that all three shadows show side by side.
constexpr double kSun_lx = 60.0, kLantern_cd = 750.0, kGuard_cd = 18000.0;

std::uint32_t add_light(const Kit& kit, const char* type, const glm::dvec3& colour, double intensity,
                        std::optional<ConeSpec> cone = {}) {
    // Candela grow with the square of the size, or a larger courtyard would be darker.
    const double area = std::string_view(type) == "directional" ? 1.0 : kit.options.scale * kit.options.scale;
    return kit.glb.add_light({type, colour, intensity * area, cone});
}

void add_sun(const Kit& kit) {
    const double elevation = glm::radians(40.0), azimuth = glm::radians(140.0);  // azimuth from +x toward +z
    const glm::dvec3 to_sun(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                            std::cos(elevation) * std::sin(azimuth));
    kit.glb.add_node({.name = "sun",
                      .translation_m = 15.0 * to_sun,
                      .rotation = facing(-to_sun),
                      .light = add_light(kit, "directional", {1.0, 0.83, 0.68}, kSun_lx)});
}

/// Makes a cage of bars around the light: rings at both ends, six bars, a floor and a roof plate.
Shape cage() {
    constexpr double kRadius = 0.16, kHalf = 0.2, kBar = 0.009;
    constexpr int kBars = 6;
    Shape shape;
    for (const double y : {-kHalf, kHalf}) {
        const glm::dmat4 place(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, 1, 0),
                               glm::dvec4(0, y, 0, 1));
        append(shape, make_ring(kRadius, 0.014, 36, 8), place);
    }
    for (int i = 0; i < kBars; ++i) {
        const double angle = 2.0 * glm::pi<double>() * i / kBars;
        const double x = kRadius * std::cos(angle), z = kRadius * std::sin(angle);
        append(shape, make_bar({x, -kHalf, z}, {x, kHalf, z}, kBar, 8));
    }
    const std::array<glm::dvec2, 6> roof{glm::dvec2(0.0, kHalf + 0.03), {0.2, kHalf + 0.03}, {0.2, kHalf + 0.045},
                                         {0.06, kHalf + 0.16},          {0.03, kHalf + 0.2}, {0.0, kHalf + 0.2}};
    append(shape, make_lathe(roof, 24, LatheNormals::creased));
    append(shape, make_bar({0.0, kHalf + 0.18, 0.0}, {0.0, 0.95, 0.0}, 0.008, 6));
    return shape;
}

void add_lantern(const Kit& kit) {
    constexpr double kDrop = 0.95;
    const glm::dvec3 pivot_m(-0.9, 3.2, -0.9);
    Shape gallows;
    append(gallows, make_box({-1.75, -3.3, -0.09}, {-1.57, 0.3, 0.09}));
    append(gallows, make_box({-1.85, 0.02, -0.06}, {0.25, 0.14, 0.06}));
    append(gallows, make_bar({-1.66, -0.6, 0.0}, {-1.0, 0.08, 0.0}, 0.045, 8));
    kit.place("gallows", gallows, kit.materials.wood, pivot_m);
    const std::uint32_t pivot = kit.mover(
        "lantern_pivot", pivot_m,
        {{"kind", "swing"}, {"axis", {0.35, 0.0, 0.94}}, {"amplitude", 0.3}, {"period_s", 3.4}, {"phase", 0.1}});
    kit.place("lantern_cage", cage(), kit.materials.brass, {0.0, -kDrop, 0.0}, {1.0, 0.0, 0.0, 0.0}, pivot);
    // The flame sits around the light, so it must not cast.
    const std::uint32_t flame = kit.glb.add_mesh("flame", make_sphere(0.045, 16, 8), kit.materials.lamp_glow);
    kit.glb.add_node({.name = "flame",
                      .parent = pivot,
                      .translation_m = {0.0, -kDrop, 0.0},
                      .mesh = flame,
                      .extras = {{"castShadow", false}}});
    kit.glb.add_node({.name = "lantern",
                      .parent = pivot,
                      .translation_m = {0.0, -kDrop, 0.0},
                      .light = add_light(kit, "point", {1.0, 0.62, 0.3}, kLantern_cd)});
}

void add_guard_lamp(const Kit& kit) {
    const glm::dvec3 head_m(-9.0, 5.6, 6.4), target_m(1.6, 0.0, 3.2);
    Shape mast;
    append(mast, make_bar({0.0, -head_m.y - 0.1, 0.0}, {0.0, -0.35, 0.0}, 0.11, 12));
    append(mast, make_box({-0.13, -0.4, -0.13}, {0.13, -0.3, 0.13}));
    kit.place("guard_mast", mast, kit.materials.iron, head_m);
    const std::uint32_t head = kit.mover(
        "guard_head", head_m, {{"kind", "swing"}, {"axis", {0, 1, 0}}, {"amplitude", 0.38}, {"period_s", 16.0}});
    // The housing is a tube behind and around the lamp, open toward -Z, narrower than the light's cone nowhere.
    const std::array<glm::dvec2, 6> housing{glm::dvec2(0.0, -0.3), {0.16, -0.3},  {0.24, 0.05},
                                            {0.225, 0.05},         {0.14, -0.27}, {0.0, -0.27}};
    const glm::dquat aim = facing(target_m - head_m);
    const glm::dquat along_forward = aim * glm::angleAxis(-0.5 * glm::pi<double>(), glm::dvec3(1.0, 0.0, 0.0));
    kit.place("guard_housing", make_lathe(housing, 24, LatheNormals::creased), kit.materials.iron, {}, along_forward,
              head);
    kit.glb.add_node({.name = "guard_lamp",
                      .parent = head,
                      .rotation = aim,
                      .light = add_light(kit, "spot", {0.78, 0.88, 1.0}, kGuard_cd,
                                         ConeSpec{glm::radians(17.0), glm::radians(21.0)})});
}

}  // namespace

void add_lamps(const Kit& kit) {
    add_sun(kit);
    add_lantern(kit);
    add_guard_lamp(kit);
}

}  // namespace gnomon::game
