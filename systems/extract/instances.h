#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/registry.h"
#include "systems/extract/snapshot.h"
#include "systems/extract/splice_instances.h"

namespace gnomon {

/// Fills SceneSnapshot::instances and its tree from entities with a WorldTransform and a MeshRef or FogVolume. All of
/// it writes what changes as snapshot.version.
class InstanceExtractor {
public:
    /// Returns true if an instance shows another mesh than it did, or if a dropped entity may have its mesh now.
    /// `lacking`: meshes that the device does not have, sorted. Call it first in each frame.
    bool any_mesh_changed(const assets::MeshLibrary& library, std::span<const std::uint32_t> lacking,
                          SceneSnapshot& snapshot);

    /// Lists all instances again.
    void list(const ecs::Registry& registry, const assets::MeshLibrary& library, SceneSnapshot& snapshot);

    enum class Splice : std::uint8_t { nothing, done, impossible };
    /// Takes entities in or out that gained or lost a MeshRef, FogVolume or WorldTransform, possibly repeated, in
    /// place. `impossible`: nothing is changed and list() is needed: entities that cannot be placed are among them, or
    /// they are a large part of the scene.
    Splice splice(const ecs::Registry& registry, const assets::MeshLibrary& library,
                  std::span<const ecs::Entity> came_or_went, SceneSnapshot& snapshot);

    /// Appends written entities to `list` that are to be an instance and are none, or the reverse, or have another
    /// mesh. `moved`, `shown`: their WorldTransform or their MeshRef was written.
    void append_exchanged(const ecs::Registry& registry, std::span<const ecs::Entity> moved,
                          std::span<const ecs::Entity> shown, const SceneSnapshot& snapshot,
                          std::vector<ecs::Entity>& list) const;

    /// Does the same for entities with a written FogVolume.
    void append_exchanged_fog(const ecs::Registry& registry, std::span<const ecs::Entity> fogged,
                              const SceneSnapshot& snapshot, std::vector<ecs::Entity>& list) const;

    /// Updates instances with a changed pose, or a changed WorldTransform. Returns false if one became unusable.
    bool bend(const assets::MeshLibrary& library, SceneSnapshot& snapshot);
    bool move(const ecs::Registry& registry, const assets::MeshLibrary& library, std::span<const ecs::Entity> moved,
              SceneSnapshot& snapshot);

    /// Updates what written instances show or cast. Returns whether any differs. A new list_version makes users rebuild
    /// their lists of casters and visible instances.
    bool mark(const ecs::Registry& registry, std::span<const ecs::Entity> shown, SceneSnapshot& snapshot);

    /// Updates boxes with a written FogVolume. Returns whether there are any. They have a new list_version as well.
    bool change_fog(const ecs::Registry& registry, std::span<const ecs::Entity> fogged, SceneSnapshot& snapshot);

    /// Returns the entities with a MeshRef or FogVolume that could not be listed.
    const std::vector<DroppedEntity>& unusable() const { return unusable_; }

private:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    bool append(const ecs::Registry& registry, const assets::MeshLibrary& library, ecs::Entity entity,
                const SceneSnapshot& snapshot, std::vector<InstanceItem>& items);
    std::uint32_t listed_at(ecs::Entity e) const;
    bool is_listed(ecs::Entity e, const SceneSnapshot& snapshot) const;
    void note_places(IndexRange changed, const SceneSnapshot& snapshot);
    void note_bent(const SceneSnapshot& snapshot);
    std::uint32_t slot_for(ecs::Entity e);
    void free_slots(const SceneSnapshot& snapshot);

    std::vector<std::uint32_t> bent_;         // instances with a pose: indices into snapshot.instances
    std::vector<std::uint32_t> instance_of_;  // entity index -> index into snapshot.instances, kNone
    std::vector<ecs::Entity> slot_owner_;     // gpu_slot -> entity
    std::vector<std::uint32_t> slot_of_;      // entity index -> gpu_slot, kNone
    std::uint32_t first_free_slot_ = 0;       // no slot below is free
    std::vector<DroppedEntity> unusable_;     // by the last list()
    std::vector<std::uint32_t> lacking_;      // as last seen
    std::uint64_t library_version_ = 0;       // as last seen
    std::uint64_t shapes_version_ = 0;        // library's version when snapshot.meshes.shapes was made
    std::vector<ecs::Entity> entities_;       // scratch
    InstanceSplice splice_;                   // scratch
};

}  // namespace gnomon
