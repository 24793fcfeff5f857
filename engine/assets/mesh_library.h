#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/assets/scene_data.h"

namespace gnomon::assets {

/// Versions of numbered things that come and go, and numbers that are free.
struct SlotVersions {
    std::vector<std::uint64_t> by_slot = {};  // shorter than the things: the others have version 0
    std::vector<std::uint32_t> free = {};

    std::uint64_t of(std::uint32_t slot) const { return slot < by_slot.size() ? by_slot[slot] : 0; }
    void set(std::uint32_t slot, std::uint64_t version) {
        if (by_slot.size() <= slot) by_slot.resize(slot + std::size_t{1}, 0);
        by_slot[slot] = version;
    }
};

/// Meshes, materials and textures that MeshRef components refer to. Once a GpuScene has it, it changes by the functions
/// below alone. Change it between frames, while no thread reads it.
struct MeshLibrary {
    std::vector<Mesh> meshes;
    std::vector<Material> materials;  // Submesh::material indexes this
    std::vector<Texture> textures;

    /// Adds a mesh in the slot of a removed one, or at the end. Its materials must exist. Returns its index.
    std::uint32_t add(Mesh mesh) {
        while (!mesh_versions.free.empty() && !is_removed(mesh_versions.free.back())) mesh_versions.free.pop_back();
        return put(meshes, std::move(mesh), mesh_versions);
    }
    /// Adds a material, as add() does. Its texture must exist.
    std::uint32_t add_material(Material material) { return put(materials, std::move(material), material_versions); }
    std::uint32_t add_texture(Texture texture) { return put(textures, std::move(texture), texture_versions); }

    /// Replaces a mesh by another one; its instances then show that.
    void replace(std::uint32_t mesh, Mesh with) {
        meshes[mesh] = std::move(with);
        mesh_versions.set(mesh, ++version);
    }
    /// Removes a mesh and frees its memory. Its slot may be taken by another mesh; entities that still name it show
    /// nothing until then.
    void remove(std::uint32_t mesh) { take(meshes, mesh, mesh_versions); }
    /// Removes a material that no mesh has, or a texture that no material has. Another one may take the slot.
    void remove_material(std::uint32_t material) { take(materials, material, material_versions); }
    void remove_texture(std::uint32_t texture) { take(textures, texture, texture_versions); }

    /// Returns the version at which the slot got its mesh, or lost it; 0: it has had one mesh since the beginning.
    std::uint64_t version_of(std::uint32_t mesh) const { return mesh_versions.of(mesh); }
    /// Returns true if the slot has had a mesh, and has none now.
    bool is_removed(std::uint32_t mesh) const { return version_of(mesh) != 0 && meshes[mesh].indices.empty(); }

    std::uint64_t version = 0;  // number of changes by these functions
    SlotVersions mesh_versions = {}, material_versions = {}, texture_versions = {};

private:
    template <class T>
    std::uint32_t put(std::vector<T>& things, T thing, SlotVersions& versions) {
        auto slot = static_cast<std::uint32_t>(things.size());
        if (versions.free.empty()) {
            things.push_back(std::move(thing));
        } else {
            slot = versions.free.back();
            versions.free.pop_back();
            things[slot] = std::move(thing);
        }
        versions.set(slot, ++version);
        return slot;
    }
    template <class T>
    void take(std::vector<T>& things, std::uint32_t slot, SlotVersions& versions) {
        things[slot] = {};
        versions.set(slot, ++version);
        versions.free.push_back(slot);
    }
};

}  // namespace gnomon::assets
