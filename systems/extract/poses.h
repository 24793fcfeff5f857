#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/components.h"
#include "gnomon/registry.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// Fills SceneSnapshot::poses from Skin and MorphWeights components. Costs nothing in a world without deformable
/// meshes.
class PoseExtractor {
public:
    /// Finds the entity that poses each mesh. Call it when entities or components were added or removed. Unchanged
    /// poses keep their versions, others get `snapshot.version`.
    void list(const ecs::Registry& registry, const assets::MeshLibrary& library, SceneSnapshot& snapshot);

    /// Returns true if any pose may change when these entities move.
    bool follows(std::span<const ecs::Entity> moved) const;

    /// Returns true if list() may find others when these entities gained or lost a mesh or a place.
    bool depends_on(const ecs::Registry& registry, std::span<const ecs::Entity> came_or_went) const;

    /// Recomputes the poses; changed ones get `snapshot.version`.
    void update(const ecs::Registry& registry, const assets::MeshLibrary& library, SceneSnapshot& snapshot);

private:
    struct Source {
        ecs::Entity entity;
        std::uint32_t mesh = 0;
    };
    std::vector<Source> sources_;           // sorted by mesh, at most one per mesh
    std::vector<std::uint8_t> moves_pose_;  // by entity index: is a joint, or has MorphWeights
    PoseItem scratch_;
};

}  // namespace gnomon
