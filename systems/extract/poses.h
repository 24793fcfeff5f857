#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "components/morph_weights.h"
#include "components/skin.h"
#include "engine/assets/mesh_library.h"
#include "engine/ecs/registry.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// Fills SceneSnapshot::poses from Skin and MorphWeights components. A world without meshes that bend costs nothing.
class PoseExtractor {
public:
    /// Finds who bends which mesh. To be called when entities or components came or went; poses that are as they were
    /// keep their versions, others get `snapshot.version`.
    void list(const ecs::Registry& registry, const assets::MeshLibrary& library, SceneSnapshot& snapshot);

    /// Whether any pose may change when these entities move.
    bool follows(std::span<const ecs::Entity> moved) const;

    /// Takes the poses anew; those that differ get `snapshot.version`.
    void update(const ecs::Registry& registry, const assets::MeshLibrary& library, SceneSnapshot& snapshot);

private:
    struct Source {
        ecs::Entity entity;
        std::uint32_t mesh = 0;
    };
    std::vector<Source> sources_;           // by rising mesh, one each
    std::vector<std::uint8_t> moves_pose_;  // by entity index: a joint, or one with MorphWeights
    PoseItem scratch_;
};

}  // namespace gnomon
