#include "bench/scaling/many_lights_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <random>
#include <string>

#include "engine/math/frustum.h"
#include "sample_game/support/built_in_scenes/primitives.h"

namespace gnomon::bench {
namespace {

constexpr double kSide_m = 120.0, kEyes_m = 1.7;
constexpr int kTiles = 10, kCells = 20;  // along a side
constexpr double kTile_m = kSide_m / kTiles, kCell_m = kSide_m / kCells;
constexpr double kFree_m = 3.0;                    // around the camera, so that no block hides all else from it
constexpr float kSun_lx = 5.0f, kLamp_cd = 60.0f;  // a dusk, so that lamps matter
constexpr glm::dvec2 kMover_m(2.0, -7.0);

enum MeshNumber : std::int32_t { kTileMesh, kColumnMesh, kBlockMesh };

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    /// Returns a random number in [from, to), from the upper 53 bits: std's distributions differ between libraries.
    double number(double from, double to) {
        return from + (to - from) * std::ldexp(static_cast<double>(engine_() >> 11U), -53);
    }

private:
    std::mt19937_64 engine_;
};

assets::Node& add_node(assets::SceneData& scene, const std::string& name, const glm::dvec3& at_m) {
    assets::Node& node = scene.nodes.emplace_back();
    node.name = name;
    node.translation_m = at_m;
    return node;
}

glm::dquat turned_back_to(const glm::dvec3& back) { return glm::quat_cast(math::basis_from_back(back)); }

void add_ground(assets::SceneData& scene) {
    for (int z = 0; z < kTiles; ++z)
        for (int x = 0; x < kTiles; ++x)
            add_node(scene, "tile", {(x + 0.5) * kTile_m - 0.5 * kSide_m, 0.0, (z + 0.5) * kTile_m - 0.5 * kSide_m})
                .mesh = kTileMesh;
}

/// Adds a column or a block in each cell, anywhere and at any angle in it.
void add_things(assets::SceneData& scene, Random random) {
    for (int z = 0; z < kCells; ++z)
        for (int x = 0; x < kCells; ++x) {
            const bool column = (x + z) % 2 == 0;
            const double wide_m = column ? random.number(0.4, 0.8) : random.number(1.0, 2.0);
            const double high_m = column ? random.number(3.0, 5.0) : random.number(0.5, 2.0);
            const double angle = random.number(0.0, std::numbers::pi);
            const glm::dvec2 at =
                glm::dvec2((x + random.number(0.2, 0.8)) * kCell_m, (z + random.number(0.2, 0.8)) * kCell_m) -
                0.5 * kSide_m;
            if (std::max(std::abs(at.x), std::abs(at.y)) < kFree_m) continue;
            assets::Node& node = add_node(scene, column ? "column" : "block", {at.x, 0.0, at.y});
            node.rotation = glm::angleAxis(angle, glm::dvec3(0.0, 1.0, 0.0));
            node.scale = {wide_m, high_m, wide_m};
            node.mesh = column ? kColumnMesh : kBlockMesh;
        }
    assets::Node& mover = add_node(scene, kDemandMover, {kMover_m.x, 0.0, kMover_m.y});
    mover.scale = {0.5, 1.8, 0.5};
    mover.mesh = kColumnMesh;
}

/// Returns place i of a sequence that spreads any number of things evenly over the unit square. It is the additive
/// recurrence by the powers of the plastic number (Roberts 2018, "The unreasonable effectiveness of quasirandom
/// sequences").
glm::dvec2 spread_point(std::uint32_t i) {
    constexpr double kPlastic = 1.32471795724474602596;
    const auto part = [&](double step) {
        const double value = 0.5 + step * (i + 1.0);
        return value - std::floor(value);
    };
    return {part(1.0 / kPlastic), part(1.0 / (kPlastic * kPlastic))};
}

void add_light(assets::SceneData& scene, std::uint32_t i, Random& random) {
    assets::LightData& light = scene.lights.emplace_back();
    light.name = "light" + std::to_string(i);
    light.casts_shadow = i < kMostShadowedLights;
    const glm::dvec2 at = (spread_point(i) - 0.5) * kSide_m;
    assets::Node& node = add_node(scene, light.name, {at.x, random.number(2.0, 3.5), at.y});
    const double tilt_x = random.number(-0.5, 0.5), tilt_z = random.number(-0.5, 0.5);
    node.rotation = turned_back_to({tilt_x, 1.0, tilt_z});
    node.light = static_cast<std::int32_t>(i);
    if (i == 0)
        light.type = assets::LightType::directional;
    else
        light.type = i % 2 == 1 ? assets::LightType::point : assets::LightType::spot;
    light.intensity = i == 0 ? kSun_lx : kLamp_cd;
    light.colour.g = static_cast<float>(random.number(0.6, 1.0));
    light.colour.b = static_cast<float>(random.number(0.3, 0.9));
    light.range_m = static_cast<float>(random.number(4.0, 6.0));
    light.outer_cone_rad = static_cast<float>(random.number(0.5, 0.9));
}

}  // namespace

assets::Mesh box_mesh(const char* name, const glm::dvec3& min, const glm::dvec3& max) {
    const game::Shape shape = game::make_box(min, max);
    assets::Mesh mesh;
    mesh.name = name;
    for (std::size_t i = 0; i < shape.positions.size(); ++i)
        mesh.vertices.push_back({shape.positions[i], shape.normals[i], shape.uvs[i]});
    mesh.indices = shape.indices;
    mesh.submeshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    assets::complete(mesh);
    return mesh;
}

assets::SceneData demand_scene(std::uint32_t lights, std::uint64_t seed) {
    assets::SceneData scene;
    scene.name = "level of " + std::to_string(lights) + " lights";
    assets::Material& matt = scene.materials.emplace_back();
    matt.base_colour = {0.7f, 0.7f, 0.7f, 1.0f};
    matt.metallic = 0.0f;
    constexpr double kHalf_m = 0.5 * kTile_m;
    scene.meshes.push_back(box_mesh("tile", {-kHalf_m, -0.5, -kHalf_m}, {kHalf_m, 0.0, kHalf_m}));
    for (const char* name : {"column", "block"})
        scene.meshes.push_back(box_mesh(name, {-0.5, 0.0, -0.5}, {0.5, 1.0, 0.5}));
    scene.cameras.emplace_back();
    assets::Node& eyes = add_node(scene, "eyes", {0.0, kEyes_m, 0.0});
    eyes.rotation = turned_back_to({0.0, 0.1, 1.0});
    eyes.camera = 0;
    add_ground(scene);
    add_things(scene, Random(seed));
    Random of_lights(seed + 1);  // a row of its own, so that fewer lights are the first of more
    for (std::uint32_t i = 0; i < lights; ++i) add_light(scene, i, of_lights);
    return scene;
}

}  // namespace gnomon::bench
