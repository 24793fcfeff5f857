#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/assets/mesh_library.h"
#include "engine/rays/mesh_bvh.h"
#include "systems/extract/snapshot.h"

namespace gnomon::visibility {

/// Whose meshes get a tree: of what casts, or also of what a camera sees.
enum class TreesOf : std::uint8_t { casters, casters_and_visible };

/// The lower level of a two-level tree over all casters: one MeshBvh per mesh that casts, in its own space. The upper
/// level is SceneSnapshot::tree, which extraction keeps anyway. Holds not a byte until update() is called for the first
/// time: who asks for no ray pays for none.
class CasterTrees {
public:
    /// `library` must outlive the trees. They are of one scene, whose versions say what changed.
    explicit CasterTrees(const assets::MeshLibrary& library, TreesOf of = TreesOf::casters)
        : library_(&library), of_(of) {}

    /// Trees of all meshes that cast (or are seen) in `scene`, bent as it says. Builds those that are missing and
    /// refits those whose pose changed; costs nothing where the scene's version is the same, and a look at each pose
    /// where its lists are.
    void update(const SceneSnapshot& scene);

    /// Null: no instance casts it (or is seen). Valid until the next update().
    const rays::MeshBvh* tree(std::uint32_t mesh) const {
        return mesh < trees_.size() && trees_[mesh].kept ? &trees_[mesh].bvh : nullptr;
    }
    const assets::MeshLibrary& library() const { return *library_; }

    struct Counts {
        std::size_t trees = 0, triangles = 0, bytes = 0;
        std::uint32_t builds = 0, refits = 0;  // by the last update() that did anything
    };
    const Counts& counts() const { return counts_; }

private:
    struct Tree {
        rays::MeshBvh bvh;
        std::uint64_t pose_version = 0;
        bool kept = false;
    };
    void list_meshes(const SceneSnapshot& scene);
    std::span<const assets::Vertex> vertices_of(const SceneSnapshot& scene, std::uint32_t mesh);

    bool wants(const InstanceItem& item) const {
        return item.casts || (of_ == TreesOf::casters_and_visible && item.visible);
    }

    const assets::MeshLibrary* library_;
    TreesOf of_;
    std::vector<Tree> trees_;           // by mesh; empty until something asks
    std::vector<assets::Vertex> bent_;  // scratch
    std::uint64_t version_ = 0, list_version_ = 0;
    Counts counts_;
};

}  // namespace gnomon::visibility
