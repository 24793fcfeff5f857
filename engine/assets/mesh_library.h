#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/assets/scene_data.h"

namespace gnomon::assets {

/// Meshes, materials and textures that MeshRef components refer to. Once a GpuScene has it, meshes change by the
/// functions below alone; materials and textures may be appended. Change it between frames, while no thread reads it.
struct MeshLibrary {
    std::vector<Mesh> meshes;
    std::vector<Material> materials;  // Submesh::material indexes this
    std::vector<Texture> textures;

    /// Adds a mesh in the slot of a removed one, or at the end. Its materials must exist. Returns its index.
    std::uint32_t add(Mesh mesh) {
        while (!free_slots.empty() && !is_removed(free_slots.back())) free_slots.pop_back();  // replaced since
        auto slot = static_cast<std::uint32_t>(meshes.size());
        if (free_slots.empty()) {
            meshes.emplace_back();
        } else {
            slot = free_slots.back();
            free_slots.pop_back();
        }
        replace(slot, std::move(mesh));
        return slot;
    }
    /// Replaces a mesh by another one; its instances then show that.
    void replace(std::uint32_t mesh, Mesh with) {
        if (versions.size() < meshes.size()) versions.resize(meshes.size(), 0);
        meshes[mesh] = std::move(with);
        versions[mesh] = ++version;
    }
    /// Removes a mesh and frees its memory. Its slot may be taken by another mesh; entities that still name it show
    /// nothing until then.
    void remove(std::uint32_t mesh) {
        replace(mesh, {});
        free_slots.push_back(mesh);
    }
    /// Returns the version at which the slot got its mesh, or lost it; 0: it has had one mesh since the beginning.
    std::uint64_t version_of(std::uint32_t mesh) const { return mesh < versions.size() ? versions[mesh] : 0; }
    /// Returns true if the slot has had a mesh, and has none now.
    bool is_removed(std::uint32_t mesh) const { return version_of(mesh) != 0 && meshes[mesh].indices.empty(); }

    std::uint64_t version = 0;                 // number of changes by these functions
    std::vector<std::uint64_t> versions = {};  // by mesh; shorter: the others have version 0
    std::vector<std::uint32_t> free_slots = {};
};

}  // namespace gnomon::assets
