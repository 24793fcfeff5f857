#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/rays/mesh_bvh.h"
#include "gnomon/assets.h"
#include "systems/extract/snapshot.h"

namespace gnomon::visibility {

/// Meshes that get a tree, over triangles that block light: those of casters, or also those of visible instances.
/// visible: those of visible instances, over triangles that pictures show as opaque (rays::MeshPart::shown).
/// translucent: those of casters, over triangles that let light through.
enum class TreesOf : std::uint8_t { casters, casters_and_visible, visible, translucent };

/// Lower level of a two-level tree over all casters: one MeshBvh per casting mesh, in its own space. The upper level is
/// SceneSnapshot::tree, which extraction maintains anyway. Uses no memory before the first update().
class CasterTrees {
public:
    /// Prepares trees for one scene. `library` must outlive them. The scene's versions mark changes.
    explicit CasterTrees(const assets::MeshLibrary& library, TreesOf of = TreesOf::casters)
        : library_(&library), of_(of) {}

    /// Updates the trees of all casting (or visible) meshes in `scene`, in their poses. Builds missing trees and refits
    /// those with a changed pose. Frees those of meshes that went. Costs nothing if the versions of scene and library
    /// are unchanged, and a look at each pose if the scene's list_version is.
    void update(const SceneSnapshot& scene);

    /// Returns a mesh's tree; null if no instance casts it (or shows it). Valid until the next update().
    const rays::MeshBvh* tree(std::uint32_t mesh) const {
        return mesh < trees_.size() && trees_[mesh].kept ? &trees_[mesh].bvh : nullptr;
    }
    const assets::MeshLibrary& library() const { return *library_; }
    /// Returns the version of the mesh that a kept tree is of.
    std::uint64_t mesh_version(std::uint32_t mesh) const { return trees_[mesh].mesh_version; }

    struct Counts {
        std::size_t trees = 0, triangles = 0, bytes = 0;
        std::uint32_t builds = 0, refits = 0;  // by the last update() with any work
    };
    const Counts& counts() const { return counts_; }

private:
    struct Tree {
        rays::MeshBvh bvh;
        std::uint64_t pose_version = 0;
        std::uint64_t mesh_version = 0;  // MeshLibrary::version_of()
        bool kept = false;
    };
    bool forget_changed();
    void list_meshes(const SceneSnapshot& scene);
    std::span<const assets::Vertex> vertices_of(const SceneSnapshot& scene, std::uint32_t mesh);

    rays::MeshPart part() const {
        if (of_ == TreesOf::translucent) return rays::MeshPart::translucent;
        return of_ == TreesOf::visible ? rays::MeshPart::shown : rays::MeshPart::blocking;
    }
    bool wants(const InstanceItem& item) const {
        return (item.casts && of_ != TreesOf::visible) ||
               ((of_ == TreesOf::casters_and_visible || of_ == TreesOf::visible) && shows_surface(item));
    }

    const assets::MeshLibrary* library_;
    TreesOf of_;
    std::vector<Tree> trees_;           // by mesh; empty before the first update()
    std::vector<assets::Vertex> bent_;  // scratch
    std::uint64_t version_ = 0, list_version_ = 0, library_version_ = 0;
    Counts counts_;
};

}  // namespace gnomon::visibility
