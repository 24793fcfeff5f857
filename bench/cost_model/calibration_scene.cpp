#include "bench/cost_model/calibration_scene.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "bench/scaling/many_lights_scene.h"
#include "engine/math/frustum.h"

namespace gnomon::bench {
namespace {

constexpr double kGround_m = 20.0, kPlates_m = 12.0, kPlate_m = 0.5;  // edges; plates cover four ninths of theirs
constexpr double kPlateHeight_m = 1.0, kLampHeight_m = 14.0, kEyeHeight_m = 24.0;
constexpr float kCone_rad = 0.7f, kLamp_cd = 500.0f;

/// Makes a flat mesh that faces up.
assets::Mesh plate(std::uint32_t cells) {
    assets::Mesh mesh;
    mesh.name = "plate";
    for (std::uint32_t z = 0; z <= cells; ++z)
        for (std::uint32_t x = 0; x <= cells; ++x) {
            const glm::vec2 at(static_cast<float>(x) / static_cast<float>(cells),
                               static_cast<float>(z) / static_cast<float>(cells));
            const glm::vec2 place = (at - 0.5f) * static_cast<float>(kPlate_m);
            mesh.vertices.push_back({{place.x, 0.0f, place.y}, {0.0f, 1.0f, 0.0f}, at});
        }
    const std::uint32_t row = cells + 1;
    for (std::uint32_t z = 0; z < cells; ++z)
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t a = z * row + x;
            for (const std::uint32_t i : {a, a + row, a + 1, a + 1, a + row, a + row + 1}) mesh.indices.push_back(i);
        }
    mesh.submeshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    assets::complete(mesh);
    return mesh;
}

assets::Node& add_node(assets::SceneData& scene, const std::string& name, const glm::dvec3& at_m) {
    assets::Node& node = scene.nodes.emplace_back();
    node.name = name;
    node.translation_m = at_m;
    return node;
}

void add_group(assets::SceneData& scene, const SpeedGroup& group, std::uint32_t g) {
    const auto first = static_cast<std::int32_t>(scene.meshes.size());
    for (std::uint32_t m = 0; m < group.meshes; ++m) scene.meshes.push_back(plate(group.cells));
    constexpr std::uint32_t kRow = 16;
    static_assert(kRow * kRow == kSpeedPlates);
    for (std::uint32_t i = 0; i < kSpeedPlates; ++i) {
        const double x = (i % kRow + 0.5) / kRow - 0.5, z = (i / kRow + 0.5) / kRow - 0.5;
        assets::Node& node =
            add_node(scene, "group" + std::to_string(g), {x * kPlates_m, kPlateHeight_m, z * kPlates_m});
        node.mesh = first + static_cast<std::int32_t>(i % group.meshes);
    }
}

void add_lamp(assets::SceneData& scene, std::uint32_t i) {
    assets::LightData& light = scene.lights.emplace_back();
    light.type = assets::LightType::spot;
    light.name = "lamp" + std::to_string(i);
    light.intensity = kLamp_cd;
    light.outer_cone_rad = kCone_rad;
    assets::Node& node = add_node(scene, light.name, {0.01 * i, kLampHeight_m, 0.0});
    node.rotation = glm::quat_cast(math::basis_from_back({0.0, 1.0, 0.0}));
    node.light = static_cast<std::int32_t>(i);
}

}  // namespace

assets::SceneData speed_scene(const SpeedGroup* groups, std::uint32_t count, std::uint32_t lamps) {
    assets::SceneData scene;
    scene.name = "plates";
    assets::Material& matt = scene.materials.emplace_back();
    matt.base_colour = {0.7f, 0.7f, 0.7f, 1.0f};
    matt.metallic = 0.0f;
    constexpr double kHalf_m = 0.5 * kGround_m;
    scene.meshes.push_back(box_mesh("ground", {-kHalf_m, -0.5, -kHalf_m}, {kHalf_m, 0.0, kHalf_m}));
    assets::Node& ground = add_node(scene, "ground", glm::dvec3(0.0));
    ground.mesh = 0;
    ground.casts_shadow = false;
    scene.cameras.emplace_back();
    assets::Node& eyes = add_node(scene, "eyes", {0.0, kEyeHeight_m, 0.0});
    eyes.rotation = glm::quat_cast(math::basis_from_back({0.0, 1.0, 0.0}));
    eyes.camera = 0;
    for (std::uint32_t g = 0; g < count; ++g) add_group(scene, groups[g], g);
    for (std::uint32_t i = 0; i < lamps; ++i) add_lamp(scene, i);
    return scene;
}

}  // namespace gnomon::bench
