#include "sample_game/support/built_in_scenes/spheres.h"

#include <glm/trigonometric.hpp>
#include <string>

#include "sample_game/support/built_in_scenes/glb_writer.h"
#include "sample_game/support/built_in_scenes/look_rotation.h"

namespace gnomon::game {
namespace {

// 2000 triangles each: two per side and ring, one where rings close.
constexpr std::uint32_t kSphereSides = 40, kSphereRings = 26;
// Spheres of 1.25 m, 2.2 m apart, so that neighbours meet, with their middles 0.8 m up, so that they meet the ground.
constexpr int kRow = 5;
constexpr double kSphere_m = 1.25, kApart_m = 2.2, kMiddle_m = 0.8;
// 500 triangles each, as thick as a pencil.
constexpr std::uint32_t kTubes = 20, kTubeSegments = 25, kTubeSides = 10;
constexpr double kTubeRing_m = 0.9, kTube_m = 0.008;
constexpr double kGround_m = 24.0;

void add_tubes(GlbBuilder& glb, std::uint32_t iron) {
    const std::uint32_t ring = glb.add_mesh("ring", make_ring(kTubeRing_m, kTube_m, kTubeSegments, kTubeSides), iron);
    for (std::uint32_t i = 0; i < kTubes; ++i) {
        // Between the spheres' rows, each turned differently, half of them through what stands beside.
        const double x = (i % kRow - 0.5 * (kRow - 1)) * kApart_m + 0.5 * kApart_m;
        const double z = (i / kRow - 1.5) * kApart_m;
        const glm::dquat upright = glm::angleAxis(glm::radians(80.0), glm::dvec3(1.0, 0.0, 0.0));
        glb.add_node({.name = "ring_" + std::to_string(i),
                      .translation_m = {x, kMiddle_m + 1.1, z},
                      .rotation = turned(27.0 * i) * upright,
                      .mesh = ring});
    }
}

}  // namespace

Spheres make_spheres() {
    GlbBuilder glb;
    const std::uint32_t sand =
        glb.add_material({.name = "sand", .base_colour = {0.55f, 0.5f, 0.4f, 1.0f}, .roughness = 1.0f});
    const std::uint32_t clay = glb.add_material({.name = "clay", .base_colour = {0.5f, 0.26f, 0.18f, 1.0f}});
    const std::uint32_t iron = glb.add_material({.name = "iron", .base_colour = {0.1f, 0.1f, 0.12f, 1.0f}});
    const double half_m = 0.5 * kGround_m;
    glb.add_node({.name = "ground",
                  .mesh = glb.add_mesh("ground", make_box({-half_m, -0.5, -half_m}, {half_m, 0.0, half_m}), sand)});
    const std::uint32_t sphere = glb.add_mesh("sphere", make_sphere(kSphere_m, kSphereSides, kSphereRings), clay);
    for (int i = 0; i < kRow * kRow; ++i) {
        const glm::dvec3 at_m((i % kRow - kRow / 2) * kApart_m, kMiddle_m, (i / kRow - kRow / 2) * kApart_m);
        glb.add_node({.name = "sphere_" + std::to_string(i),
                      .translation_m = at_m,
                      .rotation = turned(11.0 * i),
                      .mesh = sphere});
    }
    add_tubes(glb, iron);
    const glm::dvec3 from_sun(0.6, -0.75, 0.35);
    const std::uint32_t sun = glb.add_light({.type = "directional", .intensity = 20000.0});
    glb.add_node({.name = "sun", .translation_m = -20.0 * from_sun, .rotation = facing(from_sun), .light = sun});
    const std::uint32_t camera = glb.add_camera({.name = "main", .fov_y_rad = glm::radians(50.0), .near_m = 0.1});
    const glm::dvec3 at_m(7.5, 5.0, 9.0);
    glb.add_node({.name = "main", .translation_m = at_m, .rotation = facing(-at_m), .camera = camera});
    Spheres spheres;
    spheres.triangles = glb.triangle_count();
    spheres.glb = glb.finish({.name = "spheres"});
    return spheres;
}

}  // namespace gnomon::game
