#pragma once
#include "gnomon/assets.h"
#include "gnomon/registry.h"
#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/extract/extract.h"
#include "systems/transform/transform_system.h"

namespace gnomon::test {

/// A file's scene as entities, moved to a time.
struct LoadedScene {
    ecs::Registry world;
    assets::MeshLibrary library;
    game::SpawnedScene spawned;
    TransformSystem transforms;
    Extractor extractor;
    SceneSnapshot snapshot;

    explicit LoadedScene(assets::SceneData scene, const glm::dvec3& offset_m = glm::dvec3(0.0)) {
        const ecs::Entity root = world.create();
        world.emplace<Transform>(root, {.translation_m = offset_m});
        spawned = game::spawn_scene(std::move(scene), world, library);
        for (const ecs::Entity node : spawned.nodes)
            world.patch<Transform>(node, [&](Transform& transform) {
                if (transform.parent == ecs::kNull) transform.parent = root;
            });
        move_to(0.0);
    }
    void move_to(double time_s, glm::uvec2 viewport_px = {64, 64}) {
        game::set_time(spawned, time_s, world);
        extractor.update(world, library, transforms.update(world), viewport_px, snapshot);
    }
    math::Aabb bounds() const { return snapshot.tree.box(); }
};

}  // namespace gnomon::test
