#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/assets/mesh_library.h"
#include "engine/ecs/registry.h"
#include "systems/extract/poses.h"
#include "systems/extract/snapshot.h"
#include "systems/transform/transform_system.h"

namespace gnomon {

/// As reports name it: by its Name, or "entity" and its index.
std::string name_of(const ecs::Registry& registry, ecs::Entity e);

/// The only reader of the registry between the transform system and the picture: applies its change lists to a
/// SceneSnapshot. To use another ECS, fill the snapshot yourself and leave this out.
class Extractor {
public:
    /// `viewport_px`: size of the picture, both > 0. Meshes are named by their index in `library`.
    /// Cost is proportional to what changed: moved entities are updated in place, added or removed ones make the
    /// lists anew; an unchanged scene costs nothing.
    void update(ecs::Registry& registry, const assets::MeshLibrary& library, const TransformReport& transforms,
                glm::uvec2 viewport_px, SceneSnapshot& snapshot);

private:
    struct Cursors {
        ecs::ChangeCursor world, mesh, caster, light, shadow, camera, name, skin, weights;
    };
    template <class T>
    bool read_changes(ecs::Registry& registry, ecs::ChangeCursor& cursor, bool structural);
    void make_lists(const ecs::Registry& registry, const assets::MeshLibrary& library,
                    const TransformReport& transforms, SceneSnapshot& snapshot);
    void list_instance(const ecs::Registry& registry, const assets::MeshLibrary& library, ecs::Entity entity,
                       SceneSnapshot& snapshot);
    void assign_slots(SceneSnapshot& snapshot);
    bool touch_bent(const assets::MeshLibrary& library, SceneSnapshot& snapshot);
    bool touch_moved(const ecs::Registry& registry, const assets::MeshLibrary& library, SceneSnapshot& snapshot);

    Cursors cursors_;
    PoseExtractor poses_;
    std::vector<std::uint32_t> bent_;             // indices into snapshot.instances: those with a pose
    std::vector<ecs::Entity> moved_;              // since the last frame, maybe repeated
    std::vector<std::uint32_t> instance_of_;      // entity index -> index into snapshot.instances, kNone
    std::vector<ecs::Entity> slot_owner_;         // gpu_slot -> entity
    std::vector<std::uint32_t> slot_of_;          // entity index -> gpu_slot, kNone
    std::vector<DroppedEntity> unusable_;         // found while making the lists
    std::vector<QuarantinedEntity> quarantined_;  // as last seen
    glm::uvec2 viewport_px_{0, 0};
    bool started_ = false;
};

}  // namespace gnomon
