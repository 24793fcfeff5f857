#include "systems/visibility/caster_trees.h"

namespace gnomon::visibility {

std::span<const assets::Vertex> CasterTrees::vertices_of(const SceneSnapshot& scene, std::uint32_t index) {
    const assets::Mesh& mesh = library_->meshes[index];
    const PoseItem* pose = mesh.deformer ? pose_of(scene, index) : nullptr;
    if (!pose) return mesh.vertices;
    assets::deform(mesh, pose->pose(), bent_);
    return bent_;
}

void CasterTrees::list_meshes(const SceneSnapshot& scene) {
    trees_.resize(library_->meshes.size());
    for (const InstanceItem& item : scene.instances) {
        if (!wants(item) || item.mesh >= trees_.size() || trees_[item.mesh].kept) continue;
        // Another mesh may have the number since the snapshot was filled.
        if (item.drawable.by_depth || item.mesh_version != library_->version_of(item.mesh)) continue;
        Tree& tree = trees_[item.mesh];
        tree.bvh =
            rays::MeshBvh(library_->meshes[item.mesh], vertices_of(scene, item.mesh), library_->materials, part());
        const PoseItem* pose = pose_of(scene, item.mesh);
        tree.pose_version = pose ? pose->version : 0;
        tree.mesh_version = library_->version_of(item.mesh);
        tree.kept = true;
        ++counts_.builds;
    }
}

/// Frees the trees of meshes that went or were replaced. Returns true if the library changed.
bool CasterTrees::forget_changed() {
    if (library_version_ == library_->version) return false;
    library_version_ = library_->version;
    for (std::uint32_t mesh = 0; mesh < trees_.size(); ++mesh)
        if (trees_[mesh].kept && trees_[mesh].mesh_version != library_->version_of(mesh)) trees_[mesh] = {};
    return true;
}

void CasterTrees::update(const SceneSnapshot& scene) {
    const bool changed = forget_changed();
    const bool counted = scene.version != 0 && !trees_.empty() && !changed;
    if (counted && scene.version == version_) return;
    counts_ = {};
    if (!counted || scene.list_version == 0 || scene.list_version != list_version_) list_meshes(scene);
    for (std::uint32_t mesh = 0; mesh < trees_.size(); ++mesh) {
        Tree& tree = trees_[mesh];
        if (!tree.kept) continue;
        if (library_->meshes[mesh].deformer) {
            const PoseItem* pose = pose_of(scene, mesh);
            const std::uint64_t wanted = pose ? pose->version : 0;
            if (wanted != tree.pose_version) {
                tree.bvh.move(library_->meshes[mesh], vertices_of(scene, mesh));
                tree.pose_version = wanted;
                ++counts_.refits;
            }
        }
        ++counts_.trees;
        counts_.triangles += tree.bvh.triangles().size();
        counts_.bytes += tree.bvh.bytes();
    }
    counts_.bytes += trees_.capacity() * sizeof(Tree) + bent_.capacity() * sizeof(assets::Vertex);
    version_ = scene.version;
    list_version_ = scene.list_version;
}

}  // namespace gnomon::visibility
