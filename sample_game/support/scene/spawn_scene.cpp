#include "sample_game/support/scene/spawn_scene.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <utility>

#include "gnomon/components.h"
#include "gnomon/light.h"
#include "sample_game/inside/frame_camera.h"
#include "sample_game/inside/scene_bounds.h"
#include "sample_game/support/scene/node_transforms.h"
#include "sample_game/support/scene/unique_names.h"

namespace gnomon::game {
namespace {

constexpr float kSun_lx = 20000.0f;
constexpr double kSunElevation_deg = 60.0, kSunAzimuth_deg = -40.0;

LightKind to_kind(assets::LightType type) {
    switch (type) {
        case assets::LightType::directional:
            return LightKind::directional;
        case assets::LightType::spot:
            return LightKind::spot;
        case assets::LightType::point:
            break;
        case assets::LightType::rectangle:
            return LightKind::rectangle;
        case assets::LightType::disc:
            return LightKind::disc;
        case assets::LightType::sphere:
            return LightKind::sphere;
        case assets::LightType::tube:
            return LightKind::tube;
    }
    return LightKind::point;
}

Light to_light(const assets::LightData& data) {
    return {.kind = to_kind(data.type),
            .colour = data.colour,
            .intensity = data.intensity,
            .range_m = data.range_m,
            .inner_cone_rad = data.inner_cone_rad,
            .outer_cone_rad = data.outer_cone_rad,
            .source_radius_m = data.radius_m,
            .width_m = data.width_m,
            .height_m = data.height_m};
}

Camera to_camera(const assets::CameraData& data, bool active) {
    return {.projection = data.kind == assets::CameraKind::perspective ? CameraProjection::perspective
                                                                       : CameraProjection::orthographic,
            .fov_y_rad = data.fov_y_rad,
            .half_height_m = data.half_height_m,
            .near_m = data.near_m,
            .far_m = data.far_m > 0.0 ? data.far_m : std::numeric_limits<double>::infinity(),
            .frame_aspect = data.aspect,
            .active = active};
}

/// One pass over the nodes; holds what the pass carries along.
class Spawner {
public:
    Spawner(const assets::SceneData& scene, ecs::Registry& registry, SpawnedScene& spawned)
        : scene_(scene), registry_(registry), spawned_(spawned) {}

    void spawn(const assets::Node& node) {
        const ecs::Entity entity = registry_.create();
        spawned_.nodes.push_back(entity);
        const Transform transform{.translation_m = node.translation_m,
                                  .rotation = node.rotation,
                                  .scale = node.scale,
                                  .parent = node.parent == assets::kNone
                                                ? ecs::kNull
                                                : spawned_.nodes[static_cast<std::size_t>(node.parent)]};
        registry_.emplace<Transform>(entity, transform);
        std::string name = node.name;
        if (node.mesh != assets::kNone) add_mesh(entity, node);
        if (node.camera != assets::kNone) name = add_camera(entity, node);
        if (node.light != assets::kNone) name = add_light(entity, node);  // unique, for reports
        registry_.emplace<Name>(entity, {std::move(name)});
        if (!node.motion.kind.empty()) spawned_.moving.push_back({entity, transform, node.motion});
    }

    void add_sun() {
        const double elevation = glm::radians(kSunElevation_deg), azimuth = glm::radians(kSunAzimuth_deg);
        const glm::dvec3 back(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                              std::cos(elevation) * std::sin(azimuth));
        const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), back));
        const ecs::Entity sun = registry_.create();
        registry_.emplace<Transform>(sun,
                                     {.rotation = glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back))});
        registry_.emplace<Light>(sun, {.kind = LightKind::directional, .intensity = kSun_lx});
        registry_.emplace<LightShadow>(sun);
        const std::string name = light_names_.next("sun", "", 0);
        registry_.emplace<Name>(sun, {name});
        spawned_.lights.push_back({sun, name});
        spawned_.sun_added = true;
    }

    void add_framed_camera(const FramedCamera& framed) {
        const ecs::Entity camera = registry_.create();
        registry_.emplace<Transform>(camera, framed.transform);
        registry_.emplace<Camera>(camera, framed.camera);
        registry_.emplace<Name>(camera, {"framed"});
        spawned_.cameras.push_back({camera, "framed"});
        spawned_.camera_added = true;
    }

    /// Adds skins after all nodes: a joint may come after the node that follows it.
    void add_skins() {
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
            if (scene_.nodes[i].skin == assets::kNone) continue;
            const assets::Skin& skin = scene_.skins[static_cast<std::size_t>(scene_.nodes[i].skin)];
            Skin component{.inverse_bind = skin.inverse_bind};
            for (const std::int32_t joint : skin.joints)
                component.joints.push_back(spawned_.nodes[static_cast<std::size_t>(joint)]);
            registry_.emplace<Skin>(spawned_.nodes[i], std::move(component));
        }
    }

private:
    void add_mesh(ecs::Entity entity, const assets::Node& node) {
        registry_.emplace<MeshRef>(entity, {.mesh = static_cast<std::uint32_t>(node.mesh),
                                            .visible = node.visible,
                                            .receives_shadow = node.receives_shadow,
                                            .shadow_catcher = node.shadow_catcher});
        if (node.casts_shadow) registry_.emplace<ShadowCaster>(entity);
        if (!node.morph_weights.empty()) registry_.emplace<MorphWeights>(entity, {node.morph_weights});
    }

    std::string add_camera(ecs::Entity entity, const assets::Node& node) {
        const assets::CameraData& data = scene_.cameras[static_cast<std::size_t>(node.camera)];
        std::string name = !node.name.empty() ? node.name : data.name;
        if (name.empty()) name = "camera" + std::to_string(spawned_.cameras.size());
        registry_.emplace<Camera>(entity, to_camera(data, spawned_.cameras.empty()));
        spawned_.cameras.push_back({entity, name});
        return name;
    }

    std::string add_light(ecs::Entity entity, const assets::Node& node) {
        const assets::LightData& data = scene_.lights[static_cast<std::size_t>(node.light)];
        std::string name = light_names_.next(node.name, data.name, spawned_.lights.size());
        registry_.emplace<Light>(entity, to_light(data));
        if (data.casts_shadow) registry_.emplace<LightShadow>(entity);
        spawned_.lights.push_back({entity, name});
        return name;
    }

    const assets::SceneData& scene_;
    ecs::Registry& registry_;
    SpawnedScene& spawned_;
    LightNames light_names_;
};

}  // namespace

SpawnedScene spawn_scene(assets::SceneData scene, ecs::Registry& registry, assets::MeshLibrary& library) {
    SpawnedScene spawned;
    const std::vector<WorldTransform> poses = world_poses(scene);
    spawned.bounds_ws = scene_bounds(scene, poses);
    Spawner spawner(scene, registry, spawned);
    for (const assets::Node& node : scene.nodes) spawner.spawn(node);
    spawner.add_skins();
    spawned.animations = std::move(scene.animations);
    spawned.played = played_channels(spawned.animations, spawned.nodes);
    if (spawned.lights.empty()) spawner.add_sun();
    if (spawned.cameras.empty()) spawner.add_framed_camera(frame_scene(scene, poses, spawned.bounds_ws));
    library = {std::move(scene.meshes), std::move(scene.materials), std::move(scene.textures)};
    return spawned;
}

void set_time(const SpawnedScene& scene, double time_s, ecs::Registry& registry) {
    apply_motion(scene.moving, time_s, registry);
    play(scene.played, time_s, registry);
}

void activate_camera(const SpawnedScene& scene, std::size_t index, ecs::Registry& registry) {
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const bool active = i == index;
        const Camera* camera = registry.get<Camera>(scene.cameras[i].entity);
        if (camera && camera->active != active)
            registry.patch<Camera>(scene.cameras[i].entity, [&](Camera& c) { c.active = active; });
    }
}

}  // namespace gnomon::game
