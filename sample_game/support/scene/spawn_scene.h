#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/box.h"
#include "gnomon/registry.h"
#include "sample_game/support/scene/animation_player.h"
#include "sample_game/support/scene/node_motion.h"

namespace gnomon::game {

struct NamedEntity {
    ecs::Entity entity;
    std::string name;
};

struct SpawnedScene {
    std::vector<ecs::Entity> nodes;    // one per node of the scene
    std::vector<NamedEntity> cameras;  // in node order; at least one; the first is active
    std::vector<NamedEntity> lights;   // in node order; at least one; names are unique
    std::vector<MovingEntity> moving;
    std::vector<assets::Animation> animations;
    std::vector<PlayedChannel> played;  // by default all of them
    math::Aabb bounds_ws;               // bounds of all meshes at rest; may be empty
    bool sun_added = false, camera_added = false;
};

/// Makes one entity per node. It has Transform (with its parent) and Name. The node decides on MeshRef, Skin,
/// MorphWeights, ShadowCaster, Light, LightShadow and Camera. Meshes, materials and textures move to `library`, which
/// is replaced. Lights are named by their node, else by their light, else light<index>: see LightNames. A scene without
/// light gets "sun": 20000 lx from 60 degrees above the horizon, 40 degrees from +x toward -z. That is a three-quarter
/// light, aligned with no wall. A scene without camera gets "framed": see frame_scene().
SpawnedScene spawn_scene(assets::SceneData scene, ecs::Registry& registry, assets::MeshLibrary& library);

/// Puts everything that the file moves where it is at that time; what does not move is not touched.
void set_time(const SpawnedScene& scene, double time_s, ecs::Registry& registry);

/// Makes camera `index` of `scene.cameras` the only active one.
void activate_camera(const SpawnedScene& scene, std::size_t index, ecs::Registry& registry);

}  // namespace gnomon::game
