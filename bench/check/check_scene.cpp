#include "bench/check/check_scene.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/math/frustum.h"
#include "sample_game/support/built_in_scenes/primitives.h"

namespace gnomon::bench {
namespace {

enum MaterialNumber : std::uint32_t { kMatt, kFence };

assets::Node& add_node(assets::SceneData& scene, const char* name, const glm::dvec3& at_m) {
    assets::Node& node = scene.nodes.emplace_back();
    node.name = name;
    node.translation_m = at_m;
    return node;
}

/// Adds a mesh and a node for it.
assets::Node& add_shape(assets::SceneData& scene, const char* name, const game::Shape& shape, MaterialNumber material,
                        const glm::dvec3& at_m) {
    assets::Mesh& mesh = scene.meshes.emplace_back();
    mesh.name = name;
    for (std::size_t i = 0; i < shape.positions.size(); ++i)
        mesh.vertices.push_back({shape.positions[i], shape.normals[i], shape.uvs[i]});
    mesh.indices = shape.indices;
    mesh.submeshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), material}};
    assets::complete(mesh);
    assets::Node& node = add_node(scene, name, at_m);
    node.mesh = static_cast<std::int32_t>(scene.meshes.size() - 1);
    return node;
}

/// Boards and gaps, a texel each.
void add_materials(assets::SceneData& scene) {
    assets::Material& matt = scene.materials.emplace_back();
    matt.base_colour = {0.7f, 0.7f, 0.7f, 1.0f};
    matt.metallic = 0.0f;
    assets::Texture& boards = scene.textures.emplace_back();
    constexpr std::uint32_t kTexels = 4;
    boards.name = "boards";
    boards.width = kTexels;
    boards.height = 1;
    boards.linear_filter = false;
    boards.wrap_u = boards.wrap_v = assets::TextureWrap::clamp;
    for (std::uint32_t i = 0; i < kTexels; ++i)
        boards.rgba.insert(boards.rgba.end(), {200, 180, 150, static_cast<std::uint8_t>(i % 2 == 0 ? 255 : 0)});
    assets::Material fence = matt;
    fence.base_colour_texture = 0;
    fence.alpha_mode = assets::AlphaMode::mask;
    fence.double_sided = true;
    scene.materials.push_back(fence);
}

void add_things(assets::SceneData& scene) {
    const auto box = [](const glm::dvec3& size_m) { return game::make_box(-0.5 * size_m, 0.5 * size_m); };
    const auto turned = [](assets::Node& node, double angle_rad, const glm::dvec3& axis) {
        node.rotation = glm::angleAxis(angle_rad, glm::normalize(axis));
    };
    add_shape(scene, "ground", box({12.0, 0.5, 12.0}), kMatt, {0.0, -0.25, 0.0});
    add_shape(scene, "back wall", box({12.0, 4.0, 0.5}), kMatt, {0.0, 2.0, -4.25});
    add_shape(scene, "side wall", box({0.5, 4.0, 8.0}), kMatt, {-4.25, 2.0, 0.0});
    turned(add_shape(scene, kCheckBlock, box({0.9, 1.3, 0.8}), kMatt, {-1.5, 0.66, -1.0}), 0.4, {0.0, 1.0, 0.0});
    turned(add_shape(scene, "stone", box({0.6, 0.5, 0.7}), kMatt, {1.4, 0.26, -0.6}), 0.9, {0.0, 1.0, 0.0});
    turned(add_shape(scene, "leaning", box({0.4, 1.8, 0.4}), kMatt, {0.3, 0.95, -2.3}), 0.3, {0.2, 0.3, 1.0});
    turned(add_shape(scene, "hanging", box({0.5, 0.4, 0.6}), kMatt, {-0.4, 2.75, -0.3}), 0.7, {0.3, 1.0, 0.1});
    turned(add_shape(scene, "overhead", box({3.4, 0.2, 2.6}), kMatt, {-0.9, 3.6, -1.2}), 0.15, {0.0, 1.0, 0.0});
    turned(add_shape(scene, "fence", game::make_card(glm::dvec3(0.0), {1.6, 0.0, 0.0}, {0.0, 1.1, 0.0}), kFence,
                     {-2.4, 0.6, 0.9}),
           1.1, {0.0, 1.0, 0.0});
}

assets::LightData& add_light(assets::SceneData& scene, const char* name, assets::LightType type, float intensity,
                             const glm::dvec3& at_m, const glm::dvec3& back) {
    assets::LightData& light = scene.lights.emplace_back();
    light.name = name;
    light.type = type;
    light.intensity = intensity;
    light.outer_cone_rad = 0.75f;
    assets::Node& node = add_node(scene, name, at_m);
    node.rotation = glm::quat_cast(math::basis_from_back(back));
    node.light = static_cast<std::int32_t>(scene.lights.size() - 1);
    return light;
}

/// Sources of a hand's width around the place of the spot light, where no caster reaches into them.
void add_area_lights(assets::SceneData& scene) {
    const glm::dvec3 at_m{2.7, 3.4, 2.2}, back{3.6, 3.6, 3.2};
    assets::LightData& rectangle = add_light(scene, "rectangle", assets::LightType::rectangle, 4000.0f, at_m, back);
    rectangle.width_m = 0.3f;
    rectangle.height_m = 0.2f;
    add_light(scene, "disc", assets::LightType::disc, 4000.0f, at_m, back).radius_m = 0.12f;
    add_light(scene, "sphere", assets::LightType::sphere, 4000.0f, at_m, back).radius_m = 0.12f;
    assets::LightData& tube = add_light(scene, "tube", assets::LightType::tube, 4000.0f, at_m, back);
    tube.width_m = 0.3f;
    tube.radius_m = 0.03f;
}

}  // namespace

assets::SceneData check_scene() {
    assets::SceneData scene;
    scene.name = "check";
    add_materials(scene);
    scene.cameras.emplace_back().name = "eyes";
    assets::Node& eyes = add_node(scene, "eyes", {3.6, 1.9, 4.6});
    eyes.rotation = glm::quat_cast(math::basis_from_back({3.6, 0.6, 5.0}));
    eyes.camera = 0;
    add_things(scene);
    add_light(scene, "sun", assets::LightType::directional, 3.0f, {}, {0.55, 1.0, 0.62});
    add_light(scene, "spot", assets::LightType::spot, 400.0f, {2.7, 3.9, 2.2}, {3.6, 3.6, 3.2});
    add_area_lights(scene);
    add_light(scene, "point", assets::LightType::point, 200.0f, {-0.1, 1.7, 0.1}, {0.0, 0.0, 1.0});
    return scene;
}

}  // namespace gnomon::bench
