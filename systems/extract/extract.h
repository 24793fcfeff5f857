#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <unordered_map>
#include <vector>

#include "engine/assets/mesh_library.h"
#include "engine/ecs/registry.h"
#include "systems/extract/snapshot.h"
#include "systems/transform/transform_system.h"

namespace gnomon {

/// The only reader of the registry between the transform system and the picture: applies its change lists to a
/// SceneSnapshot. To use another ECS, fill the snapshot yourself and leave this out.
class Extractor {
public:
    /// `viewport_px`: size of the picture, both > 0. `library` must outlive the call; meshes are named by index.
    /// Cost is proportional to the number of changed components; an unchanged scene costs nothing.
    void update(ecs::Registry& registry, const assets::MeshLibrary& library, const TransformReport& transforms,
                glm::uvec2 viewport_px, SceneSnapshot& snapshot);

private:
    struct Cursors {
        ecs::ChangeCursor world, mesh, caster, light, shadow, camera, name;
    };
    bool collect_changes(ecs::Registry& registry);
    void rebuild_instances(const ecs::Registry&, const assets::MeshLibrary&, SceneSnapshot&);

    Cursors cursors_;
    std::vector<ecs::Entity> changed_;
    std::vector<std::uint32_t> free_slots_;
    std::vector<ecs::Entity> slot_owner_;
    glm::uvec2 viewport_px_{0, 0};
    std::uint64_t next_version_ = 1;
};

}  // namespace gnomon
