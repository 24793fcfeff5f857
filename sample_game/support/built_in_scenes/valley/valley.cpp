#include "sample_game/support/built_in_scenes/valley/valley.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "sample_game/support/built_in_scenes/look_rotation.h"
#include "sample_game/support/built_in_scenes/textures.h"
#include "sample_game/support/built_in_scenes/valley/parts.h"

namespace gnomon::game {
namespace {

ValleyMaterials add_valley_materials(GlbBuilder& glb) {
    const std::uint32_t leaves = glb.add_texture("leaves", leaf_texture_png());
    ValleyMaterials m{};
    m.grass = glb.add_material({.name = "grass", .base_colour = {0.2f, 0.3f, 0.11f, 1.0f}, .roughness = 1.0f});
    m.plaster = glb.add_material({.name = "plaster", .base_colour = {0.7f, 0.65f, 0.56f, 1.0f}, .roughness = 0.95f});
    m.roof = glb.add_material({.name = "roof", .base_colour = {0.36f, 0.13f, 0.08f, 1.0f}, .roughness = 0.9f});
    m.wood = glb.add_material({.name = "wood", .base_colour = {0.3f, 0.2f, 0.11f, 1.0f}});
    m.bark = glb.add_material({.name = "bark", .base_colour = {0.16f, 0.11f, 0.07f, 1.0f}, .roughness = 1.0f});
    m.needles = glb.add_material({.name = "needles", .base_colour = {0.06f, 0.15f, 0.07f, 1.0f}, .roughness = 1.0f});
    m.leaves = glb.add_material({.name = "leaves", .texture = leaves, .alpha_cutoff = 0.5f, .double_sided = true});
    return m;
}

void add_sun(GlbBuilder& glb) {
    const double elevation = glm::radians(36.0), azimuth = glm::radians(25.0);  // azimuth from +x toward +z
    const glm::dvec3 to_sun(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                            std::cos(elevation) * std::sin(azimuth));
    const std::uint32_t light =
        glb.add_light({.type = "directional", .colour = {1.0, 0.93, 0.83}, .intensity = 20000.0});
    glb.add_node({.name = "sun", .translation_m = 100.0 * to_sun, .rotation = facing(-to_sun), .light = light});
}

void add_valley_cameras(GlbBuilder& glb) {
    constexpr double kNear_m = 0.1, kEye_m = 1.7, kFov_deg = 55.0;
    struct View {
        const char* name;
        double x_m, z_m, above_m;
        glm::dvec3 target_m;
    };
    // Where one looks: down the lane; over the fields at the village's side; down at it, as from a tower.
    const View views[] = {{"lane", 1.2, 6.0, kEye_m, {0.0, 2.5, -60.0}},
                          {"meadow", 96.0, 44.0, kEye_m, {-60.0, 6.0, -190.0}},
                          {"hill", 260.0, 190.0, 30.0, {-40.0, 0.0, -260.0}}};
    for (const View& view : views) {
        const std::uint32_t camera =
            glb.add_camera({.name = view.name, .fov_y_rad = glm::radians(kFov_deg), .near_m = kNear_m});
        const glm::dvec3 at_m(view.x_m, ground_height_m(view.x_m, view.z_m) + view.above_m, view.z_m);
        glb.add_node(
            {.name = view.name, .translation_m = at_m, .rotation = facing(view.target_m - at_m), .camera = camera});
    }
}

}  // namespace

Valley make_valley() {
    GlbBuilder glb;
    const ValleyKit kit{.glb = glb, .materials = add_valley_materials(glb)};
    add_valley_cameras(glb);
    add_sun(glb);
    add_valley_ground(kit);
    add_houses(kit);
    add_woods(kit);
    add_lane(kit);
    Valley valley;
    valley.triangles = glb.triangle_count();
    valley.glb = glb.finish({.name = "valley"});
    return valley;
}

}  // namespace gnomon::game
