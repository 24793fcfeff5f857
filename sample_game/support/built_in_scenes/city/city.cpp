#include "sample_game/support/built_in_scenes/city/city.h"

#include <cmath>
#include <glm/trigonometric.hpp>

#include "sample_game/support/built_in_scenes/city/parts.h"
#include "sample_game/support/built_in_scenes/look_rotation.h"

namespace gnomon::game {
namespace {

void add_sun(const CityKit& kit) {
    const double elevation = glm::radians(34.0), azimuth = glm::radians(72.0);  // azimuth from +x toward +z
    const glm::dvec3 to_sun(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                            std::cos(elevation) * std::sin(azimuth));
    const std::uint32_t light =
        kit.glb.add_light({.type = "directional", .colour = {1.0, 0.82, 0.64}, .intensity = 600.0});
    kit.glb.add_node({.name = "sun", .translation_m = 100.0 * to_sun, .rotation = facing(-to_sun), .light = light});
}

void add_cameras(const CityKit& kit) {
    struct View {
        const char* name;
        glm::dvec3 at_m, target_m;
    };
    // Beside a crossing; from a roof over the streets; over the whole city.
    const View views[] = {{"street", {30.0, 3.4, 47.0}, {43.0, 2.0, -20.0}},
                          {"roof", {-20.0, 42.0, 60.0}, {80.0, 0.0, -140.0}},
                          {"air", {-700.0, 420.0, 1100.0}, {100.0, 0.0, -200.0}}};
    for (const View& view : views) {
        const std::uint32_t camera =
            kit.glb.add_camera({.name = view.name, .fov_y_rad = glm::radians(55.0), .near_m = 0.1});
        kit.glb.add_node({.name = view.name,
                          .translation_m = view.at_m,
                          .rotation = facing(view.target_m - view.at_m),
                          .camera = camera});
    }
}

}  // namespace

std::uint32_t CityKit::place(const std::string& name, std::uint32_t mesh, const glm::dvec3& at_m,
                             double turn_deg) const {
    return glb.add_node({.name = name, .translation_m = at_m, .rotation = turned(turn_deg), .mesh = mesh});
}

glm::dvec3 CityKit::middle_m(int column, int row) const {
    return {(column - options.blocks / 2) * kBlock_m, 0.0, (row - options.blocks / 2) * kBlock_m};
}

City make_city(const CityOptions& options) {
    constexpr std::uint32_t kSeed = 7;
    GlbBuilder glb;
    std::mt19937 random(kSeed);
    const CityMeshes meshes = add_city_meshes(glb);
    const CityKit kit{.glb = glb, .options = options, .meshes = meshes, .random = random};
    add_cameras(kit);
    add_sun(kit);
    add_blocks(kit);
    add_traffic(kit);
    City city;
    city.triangles = glb.triangle_count();
    city.glb = glb.finish({.name = "city"});
    return city;
}

}  // namespace gnomon::game
