#include "tests/stability/hard_cases_world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gnomon/components.h"
#include "sample_game/support/settings/light_settings.h"

namespace gnomon::hard {
namespace {

constexpr float kSun_lx = 20000.0f, kLamp_cd = 3000.0f;

assets::Mesh mesh_of(const game::Shape& shape, std::uint32_t material) {
    assets::Mesh mesh;
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
        mesh.vertices.push_back({shape.positions[i], shape.normals[i], shape.uvs[i]});
        mesh.bounds_ms = math::extended(mesh.bounds_ms, glm::dvec3(shape.positions[i]));
    }
    mesh.indices = shape.indices;
    mesh.submeshes = {{0, static_cast<std::uint32_t>(shape.indices.size()), material}};
    return mesh;
}

}  // namespace

glm::dquat looking_along(const glm::dvec3& direction) {
    return glm::normalize(glm::quat_cast(math::basis_from_back(-direction)));
}

World::World() { library.materials.push_back({.name = "matt", .metallic = 0.0f}); }

std::uint32_t World::mesh(const game::Shape& shape, std::uint32_t material) {
    library.meshes.push_back(mesh_of(shape, material));
    return static_cast<std::uint32_t>(library.meshes.size() - 1);
}

std::uint32_t World::triangles(const std::vector<glm::vec3>& corners) {
    game::Shape shape;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t first = i - i % 3;
        const glm::vec3 n = glm::cross(corners[first + 1] - corners[first], corners[first + 2] - corners[first]);
        const float size = glm::length(n);
        shape.positions.push_back(corners[i]);
        shape.normals.push_back(size > 0.0f ? n / size : glm::vec3(0.0f, 1.0f, 0.0f));
        shape.uvs.emplace_back(0.0f);
        shape.indices.push_back(static_cast<std::uint32_t>(i));
    }
    return mesh(shape);
}

Transform World::placed(Transform t) const {
    t.translation_m = t.translation_m * scale + offset_m;
    t.scale *= scale;
    return t;
}

ecs::Entity World::place(std::uint32_t mesh, const Transform& transform, bool casts) {
    const ecs::Entity entity = registry.create();
    registry.emplace<Transform>(entity, placed(transform));
    registry.emplace<MeshRef>(entity, {.mesh = mesh});
    if (casts) registry.emplace<ShadowCaster>(entity);
    return entity;
}

ecs::Entity World::box(const glm::dvec3& min, const glm::dvec3& max, const Transform& transform) {
    return place(mesh(game::make_box(min, max)), transform);
}

ecs::Entity World::ground(double half_m, const glm::dvec3& at) {
    const glm::dvec3 right(0.0, 0.0, 2.0 * half_m), up(2.0 * half_m, 0.0, 0.0);
    return place(mesh(game::make_card(kOrigin, right, up)), {.translation_m = at}, false);
}

ecs::Entity World::light(const Light& light, const glm::dvec3& at, const glm::dvec3& direction,
                         const LightShadow& shadow, const ShadowTuning& tuning) {
    const ecs::Entity entity = registry.create();
    Light scaled = light;
    scaled.range_m = static_cast<float>(static_cast<double>(light.range_m) * scale);
    if (light.kind != LightKind::directional) scaled.intensity *= static_cast<float>(scale * scale);
    registry.emplace<Transform>(entity, {at * scale + offset_m, looking_along(direction)});
    registry.emplace<Light>(entity, scaled);
    game::LightSettings set{.shadow = shadow, .tuning = tuning};
    for (const std::string& setting : settings)
        if (const auto error = game::apply_setting(set, setting)) throw std::invalid_argument(to_line(*error));
    game::put_settings(registry, entity, set);
    return entity;
}
ecs::Entity World::sun(const glm::dvec3& direction, const LightShadow& shadow, const ShadowTuning& tuning) {
    return light({.kind = LightKind::directional, .intensity = kSun_lx}, kOrigin, direction, shadow, tuning);
}
ecs::Entity World::lamp(const glm::dvec3& at, double range_m, const LightShadow& shadow, const ShadowTuning& tuning) {
    return light({.kind = LightKind::point, .intensity = kLamp_cd, .range_m = static_cast<float>(range_m)}, at, kDown,
                 shadow, tuning);
}
ecs::Entity World::spot(const glm::dvec3& at, const glm::dvec3& direction, double outer_rad,
                        const LightShadow& shadow) {
    const auto outer = static_cast<float>(outer_rad);
    return light({.kind = LightKind::spot, .intensity = kLamp_cd, .outer_cone_rad = outer}, at, direction, shadow);
}
void World::three_lights() {
    sun(kSlant);
    lamp({1.5, 4.0, -1.0});
    spot({-2.0, 5.0, 1.0}, {0.4, -1.0, -0.2}, 0.7);
}

ecs::Entity World::camera(const glm::dvec3& at, const glm::dvec3& target, const Camera& camera) {
    const ecs::Entity entity = registry.create();
    Camera scaled = camera;
    scaled.near_m *= scale;
    scaled.far_m *= scale;
    scaled.half_height_m *= scale;
    registry.emplace<Transform>(entity, {at * scale + offset_m, looking_along(target - at)});
    registry.emplace<Camera>(entity, scaled);
    return entity;
}

void World::move(ecs::Entity entity, const Transform& unscaled) {
    registry.patch<Transform>(entity, [&](Transform& t) { t = placed(unscaled); });
}

void World::nudge_cameras() {
    constexpr double kStep_m = 0.07, kGlance_rad = 0.02;
    const auto cameras = registry.entities_with<Camera>();
    for (const ecs::Entity e : std::vector<ecs::Entity>(cameras.begin(), cameras.end()))
        registry.patch<Transform>(e, [&](Transform& t) {
            t.translation_m += glm::dvec3(kStep_m, 0.2 * kStep_m, -kStep_m) * scale;
            t.rotation = glm::angleAxis(kGlance_rad, glm::dvec3(0.0, 1.0, 0.0)) * t.rotation;
        });
}

Stages::Stages(World& world) : world_(world) {
    auto scene = GpuScene::create(device_, world.library);
    gpu_scene_ = std::make_unique<GpuScene>(std::move(scene).value());
    shadows_ = std::make_unique<shadow::ShadowSystem>(device_);
}
Stages::~Stages() = default;

void Stages::run() {
    commands_.clear();
    report_.clear();
    const TransformReport& transforms = transforms_.update(world_.registry);
    extractor_.update(world_.registry, world_.library, transforms, world_.viewport_px, snapshot_);
    gpu_scene_->update(snapshot_, commands_);
    shadows_->update(snapshot_, *gpu_scene_, {}, commands_, report_);
    shadows_->report(snapshot_, {}, report_);
    shadows_->commit(snapshot_, device_.submit(commands_).failure == gl::Failure::none);
}

std::vector<const shadow::ShadowView*> Stages::views(std::uint32_t light) const {
    std::vector<const shadow::ShadowView*> found;
    for (const shadow::ShadowView& view : frame().fitted.views_of(light)) found.push_back(&view);
    return found;
}

std::size_t Stages::passes() const {
    std::size_t count = 0;
    for (const LightReport& light : report_.lights) count += light.counts.views_drawn;
    return count;
}

}  // namespace gnomon::hard
