#include "sample_game/support/built_in_scenes/courtyard/courtyard.h"

#include <glm/trigonometric.hpp>

#include "sample_game/support/built_in_scenes/courtyard/parts.h"
#include "sample_game/support/built_in_scenes/textures.h"

namespace gnomon::game {

Materials add_materials(GlbBuilder& glb) {
    const std::uint32_t paving = glb.add_texture("paving", paving_texture_png());
    const std::uint32_t leaves = glb.add_texture("leaves", leaf_texture_png());
    const std::uint32_t cloth = glb.add_texture("cloth", cloth_texture_png());
    Materials m{};
    m.paving = glb.add_material({.name = "paving", .texture = paving, .roughness = 0.9f});
    m.plaster = glb.add_material({.name = "plaster", .base_colour = {0.68f, 0.62f, 0.53f, 1.0f}, .roughness = 0.95f});
    m.stone = glb.add_material({.name = "stone", .base_colour = {0.5f, 0.49f, 0.46f, 1.0f}});
    m.wood = glb.add_material({.name = "wood", .base_colour = {0.3f, 0.17f, 0.08f, 1.0f}});
    m.iron = glb.add_material(
        {.name = "iron", .base_colour = {0.12f, 0.12f, 0.13f, 1.0f}, .metallic = 0.3f, .roughness = 0.5f});
    m.brass = glb.add_material(
        {.name = "brass", .base_colour = {0.78f, 0.57f, 0.24f, 1.0f}, .metallic = 0.7f, .roughness = 0.4f});
    m.red = glb.add_material({.name = "red_paint", .base_colour = {0.5f, 0.07f, 0.05f, 1.0f}, .roughness = 0.6f});
    m.blue = glb.add_material({.name = "blue_paint", .base_colour = {0.08f, 0.16f, 0.42f, 1.0f}, .roughness = 0.6f});
    m.leaves = glb.add_material({.name = "leaves", .texture = leaves, .alpha_cutoff = 0.5f, .double_sided = true});
    m.cloth = glb.add_material({.name = "cloth", .texture = cloth, .alpha_cutoff = 0.5f, .double_sided = true});
    m.bark = glb.add_material({.name = "bark", .base_colour = {0.16f, 0.11f, 0.07f, 1.0f}, .roughness = 1.0f});
    m.lamp_glow = glb.add_material(
        {.name = "lamp_glow", .base_colour = {1.0f, 0.9f, 0.7f, 1.0f}, .emissive = {1.0f, 0.8f, 0.5f}});
    return m;
}

void add_cameras(const Kit& kit) {
    constexpr double kNear_m = 0.05;
    struct View {
        const char* name;
        glm::dvec3 at_m, target_m;
        double fov_y_deg;
    };
    const View views[] = {{"main", {9.6, 5.2, 11.8}, {-0.6, 0.9, -0.6}, 50.0},
                          {"top", {0.0, 30.0, 6.0}, {0.0, 0.0, -0.4}, 45.0},
                          {"low", {-6.5, 0.6, 7.6}, {0.8, 1.5, -1.5}, 60.0}};
    for (const View& view : views) {
        const std::uint32_t camera = kit.glb.add_camera(
            {.name = view.name, .fov_y_rad = glm::radians(view.fov_y_deg), .near_m = kNear_m * kit.options.scale});
        kit.glb.add_node({.name = view.name,
                          .translation_m = view.at_m,
                          .rotation = facing(view.target_m - view.at_m),
                          .camera = camera});
    }
}

Courtyard make_courtyard(const CourtyardOptions& options) {
    GlbBuilder glb;
    Kit kit{.glb = glb, .materials = add_materials(glb), .options = options};
    if (!options.casters) kit.mesh_extras = {{"castShadow", false}};
    add_cameras(kit);
    add_lamps(kit);
    add_architecture(kit);
    add_furniture(kit);
    add_guard(kit);
    if (options.game) add_game(kit);
    Courtyard courtyard;
    courtyard.triangles = glb.triangle_count();
    courtyard.glb = glb.finish({.name = "courtyard", .translation_m = options.offset_m, .scale = options.scale});
    return courtyard;
}

}  // namespace gnomon::game
