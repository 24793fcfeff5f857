#include "sample_game/support/built_in_scenes/panes.h"

#include <array>
#include <glm/trigonometric.hpp>
#include <string>

#include "sample_game/support/built_in_scenes/glb_writer.h"
#include "sample_game/support/built_in_scenes/look_rotation.h"

namespace gnomon::game {
namespace {

constexpr double kPane_m = 0.9, kBar_m = 0.06;  // edge of a pane of the window, and half of a lead bar
constexpr int kColumns = 4, kRows = 2;
constexpr float kCover = 0.94f;  // share of a pane that is glass of its colour

struct Glass {
    const char* name;
    glm::vec3 colour;
};
constexpr std::array kGlasses{Glass{"ruby", {0.9f, 0.06f, 0.05f}}, Glass{"emerald", {0.05f, 0.65f, 0.2f}},
                              Glass{"sapphire", {0.06f, 0.15f, 0.9f}}, Glass{"amber", {1.0f, 0.55f, 0.05f}}};

using Glasses = std::array<std::uint32_t, kGlasses.size()>;

Glasses add_glasses(GlbBuilder& glb) {
    Glasses glasses{};
    for (std::size_t i = 0; i < kGlasses.size(); ++i)
        glasses[i] = glb.add_material({.name = kGlasses[i].name,
                                       .base_colour = glm::vec4(kGlasses[i].colour, kCover),
                                       .roughness = 0.3f,
                                       .double_sided = true,
                                       .blended = true,
                                       .transmission = 1.0f});
    return glasses;
}

void add_window(GlbBuilder& glb, const Glasses& glasses, std::uint32_t lead) {
    std::array<std::uint32_t, kGlasses.size()> panes{};
    for (std::size_t i = 0; i < panes.size(); ++i)
        panes[i] = glb.add_mesh(std::string("pane_") + kGlasses[i].name,
                                make_card(glm::dvec3(0.0), {kPane_m, 0.0, 0.0}, {0.0, kPane_m, 0.0}), glasses[i]);
    const std::uint32_t upright =
        glb.add_mesh("upright", make_box({-kBar_m, 0.0, -kBar_m}, {kBar_m, kRows * kPane_m + 0.4, kBar_m}), lead);
    const double half_m = 0.5 * kColumns * kPane_m;
    const std::uint32_t rail =
        glb.add_mesh("rail", make_box({-half_m, -kBar_m, -kBar_m}, {half_m, kBar_m, kBar_m}), lead);
    for (int column = 0; column <= kColumns; ++column)
        glb.add_node({.name = "upright_" + std::to_string(column),
                      .translation_m = {column * kPane_m - half_m, 0.0, 0.0},
                      .mesh = upright});
    for (int row = 0; row <= kRows; ++row)
        glb.add_node(
            {.name = "rail_" + std::to_string(row), .translation_m = {0.0, 0.4 + row * kPane_m, 0.0}, .mesh = rail});
    for (int i = 0; i < kColumns * kRows; ++i) {
        const int column = i % kColumns, row = i / kColumns;
        glb.add_node({.name = "pane_" + std::to_string(i),
                      .translation_m = {(column + 0.5) * kPane_m - half_m, 0.4 + (row + 0.5) * kPane_m, 0.0},
                      .mesh = panes[static_cast<std::size_t>((column + 2 * row) % kColumns)]});
    }
}

/// Adds two panes that overlap above the floor, a ball below and one above them, and a shelf between.
void add_stack(GlbBuilder& glb, const Glasses& glasses, std::uint32_t plaster) {
    const auto sheet = [&](const char* name, std::uint32_t glass, const glm::dvec3& at_m, double degrees) {
        const Shape card = make_card(glm::dvec3(0.0), {1.3, 0.0, 0.0}, {0.0, 0.0, -1.3});
        glb.add_node({.name = name,
                      .translation_m = at_m,
                      .rotation = game::turned(degrees),
                      .mesh = glb.add_mesh(name, card, glass)});
    };
    sheet("lower", glasses[3], {2.9, 0.9, 1.5}, 12.0);
    sheet("upper", glasses[2], {3.3, 1.5, 1.9}, 40.0);
    const std::uint32_t ball = glb.add_mesh("ball", make_sphere(0.28, 32, 20), plaster);
    glb.add_node({.name = "ball_below", .translation_m = {2.75, 0.28, 1.35}, .mesh = ball});
    glb.add_node({.name = "ball_above", .translation_m = {3.6, 1.95, 2.1}, .mesh = ball});
}

}  // namespace

std::vector<std::byte> make_panes() {
    GlbBuilder glb;
    const std::uint32_t plaster = glb.add_material({.name = "plaster", .base_colour = {0.75f, 0.74f, 0.7f, 1.0f}});
    const std::uint32_t lead = glb.add_material({.name = "lead", .base_colour = {0.12f, 0.12f, 0.13f, 1.0f}});
    glb.add_node(
        {.name = "floor", .mesh = glb.add_mesh("floor", make_box({-6.0, -0.2, -3.0}, {6.0, 0.0, 6.0}), plaster)});
    const Glasses glasses = add_glasses(glb);
    add_window(glb, glasses, lead);
    add_stack(glb, glasses, plaster);
    const glm::dvec3 from_sun(0.25, -0.62, 0.74);
    const std::uint32_t sun = glb.add_light({.type = "directional", .intensity = 20000.0});
    glb.add_node({.name = "sun", .translation_m = -20.0 * from_sun, .rotation = facing(from_sun), .light = sun});
    const std::uint32_t spot = glb.add_light({.type = "spot", .intensity = 150000.0, .cone = ConeSpec{0.22, 0.3}});
    const glm::dvec3 spot_m(4.4, 5.0, 1.0), toward(-1.3, -5.0, 0.9);
    glb.add_node({.name = "spot", .translation_m = spot_m, .rotation = facing(toward), .light = spot});
    const std::uint32_t camera = glb.add_camera({.name = "main", .fov_y_rad = glm::radians(42.0), .near_m = 0.1});
    const glm::dvec3 at_m(2.2, 4.0, 7.2);
    glb.add_node({.name = "main",
                  .translation_m = at_m,
                  .rotation = facing(glm::dvec3(1.1, 0.6, 1.0) - at_m),
                  .camera = camera});
    return glb.finish({.name = "panes"});
}

}  // namespace gnomon::game
