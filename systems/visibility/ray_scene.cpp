#include "systems/visibility/ray_scene.h"

#include <algorithm>
#include <span>

namespace gnomon::visibility {
namespace {

/// Bounds the nodes of a tree. A rebuilt tree may have more nodes than before, but a leaf has at least one triangle.
std::uint32_t most_nodes(const rays::MeshBvh& tree, bool bends) {
    const auto triangles = static_cast<std::uint32_t>(tree.triangles().size());
    if (triangles == 0) return 0;
    return bends ? 2 * triangles - 1 : static_cast<std::uint32_t>(tree.nodes().size());
}

std::uint64_t pose_version(const SceneSnapshot& scene, std::uint32_t mesh) {
    const PoseItem* pose = pose_of(scene, mesh);
    return pose ? pose->version : 0;
}

template <class T>
gl::BufferHandle filled(gl::Device& device, const char* label, const std::vector<T>& values) {
    static_assert(sizeof(T) % gl::kTexelBytes == 0);
    const gl::BufferDesc desc{label, values.size() * sizeof(T), gl::BufferUse::updated, true};
    return device.create_buffer(desc, std::as_bytes(std::span(values))).handle;
}

}  // namespace

RayScene::Held::Held(gl::Device& device, const assets::MeshLibrary& library)
    : trees(library),
      masks(library),
      top_buffer(device, "ray tree of instances", true),
      instance_buffer(device, "ray instances", true) {}

void RayScene::free_meshes() {
    for (const gl::BufferHandle buffer : {buffers_.nodes, buffers_.triangles, buffers_.masks}) device_.destroy(buffer);
    buffers_ = {};
    if (held_) held_->mesh_bytes = 0;
}

void RayScene::release() {
    free_meshes();
    held_.reset();
    report_ = {};
    asked_ = 0;
    retry_ = {};
    forgotten_ = false;
}

bool RayScene::update(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list) {
    if (!retry_.due(++asked_)) return false;
    if (!held_) held_.emplace(device_, gpu.library());
    held_->trees.update(scene);
    const bool made = buffers_.nodes && !forgotten_ && held_->placed_trees == held_->trees.counts().trees;
    report_.meshes_written = 0;
    report_.instances_written = false;
    bool ready = made || make_meshes(scene, gpu);
    if (ready && made) rewrite_bent(scene, gpu, list);
    ready = ready && write_instances(scene, !made, list);
    if (!ready) free_meshes();
    if (!ready) retry_.failed(asked_);
    if (ready) forgotten_ = false;
    count();
    return ready;
}

/// Appends a mesh's triangles by slot, as shaders read them.
void RayScene::take_triangles(const GpuScene& gpu, std::uint32_t mesh) {
    const std::uint32_t first = gpu.mesh(mesh).first_index / 3;
    for (rays::BvhTriangle triangle : held_->trees.tree(mesh)->triangles()) {
        if (triangle.mask != rays::kOpaque) {
            const RayMasks::Place place = held_->masks.place(mesh, triangle.triangle, triangle.mask);
            triangle.mask = place.mask;
            triangle.spare = place.uvs;
        }
        triangle.triangle += first;
        held_->scratch.push_back(triangle);
    }
}

/// Uploads all meshes' trees, one after the other.
bool RayScene::make_meshes(const SceneSnapshot& scene, const GpuScene& gpu) {
    free_meshes();
    const std::size_t meshes = gpu.library().meshes.size();
    held_->places.assign(meshes, {});
    held_->pose_versions.assign(meshes, 0);
    held_->placed_trees = held_->trees.counts().trees;
    held_->scratch.clear();
    std::vector<rays::BvhNode> nodes;
    for (std::uint32_t mesh = 0; mesh < meshes; ++mesh) {
        const rays::MeshBvh* tree = held_->trees.tree(mesh);
        if (!tree || tree->nodes().empty()) continue;
        held_->places[mesh] = {static_cast<std::uint32_t>(nodes.size()),
                               static_cast<std::uint32_t>(tree->nodes().size()),
                               static_cast<std::uint32_t>(held_->scratch.size()),
                               tree->box(),
                               {}};
        held_->pose_versions[mesh] = pose_version(scene, mesh);
        const bool bends = gpu.library().meshes[mesh].deformer != nullptr;
        if (!bends) held_->places[mesh].tree = tree->nodes();
        nodes.insert(nodes.end(), tree->nodes().begin(), tree->nodes().end());
        nodes.resize(held_->places[mesh].first_node + most_nodes(*tree, bends));
        take_triangles(gpu, mesh);
    }
    if (nodes.empty()) nodes.emplace_back();  // a buffer must have a size
    if (held_->scratch.empty()) held_->scratch.emplace_back();
    const std::span<const std::uint32_t> words = held_->masks.words();
    held_->mesh_bytes =
        nodes.size() * sizeof(rays::BvhNode) + held_->scratch.size() * sizeof(rays::BvhTriangle) + words.size_bytes();
    buffers_.nodes = filled(device_, "ray trees of meshes", nodes);
    if (buffers_.nodes) buffers_.triangles = filled(device_, "ray triangles", held_->scratch);
    if (buffers_.triangles && !words.empty())
        buffers_.masks =
            device_.create_buffer({"ray masks", words.size_bytes(), gl::BufferUse::fixed}, std::as_bytes(words)).handle;
    held_->scratch = {};
    return buffers_.triangles && (words.empty() || buffers_.masks);
}

void RayScene::rewrite_bent(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list) {
    for (const PoseItem& pose : scene.poses) {
        const rays::MeshBvh* tree = held_->trees.tree(pose.mesh);
        if (!tree || tree->nodes().empty() || held_->pose_versions[pose.mesh] == pose.version) continue;
        MeshTreePlace& place = held_->places[pose.mesh];
        place.nodes = static_cast<std::uint32_t>(tree->nodes().size());
        place.box = tree->box();
        held_->pose_versions[pose.mesh] = pose.version;
        held_->scratch.clear();
        take_triangles(gpu, pose.mesh);
        list.update(buffers_.nodes, std::uint64_t{place.first_node} * sizeof(rays::BvhNode), tree->nodes());
        list.update(buffers_.triangles, std::uint64_t{place.first_slot} * sizeof(rays::BvhTriangle),
                    std::span<const rays::BvhTriangle>(held_->scratch));
        ++report_.meshes_written;
    }
}

/// Returns true if all instances are as when the upper level was written.
bool RayScene::stand_still(const SceneSnapshot& scene) const {
    if (scene.version == 0 || scene.version == held_->version) return scene.version != 0;
    const bool all_are_named =
        scene.version == held_->version + 1 && scene.list_version != 0 && scene.list_version == held_->list_version;
    return all_are_named && scene.changed_instances.empty();
}

/// Writes the upper level. `all`: the device's contents are unknown.
bool RayScene::write_instances(const SceneSnapshot& scene, bool all, gl::CommandList& list) {
    const bool still = !all && stand_still(scene);
    if (still) held_->version = scene.version;
    if (still) return true;
    const bool same = !all && scene.list_version != 0 && scene.list_version == held_->list_version;
    InstanceTree& tree = held_->instances;
    tree.update(scene, held_->places, same);
    held_->version = scene.version;
    held_->list_version = scene.list_version;
    const std::uint64_t top_bytes =
        sizeof(RayTop) + std::max<std::size_t>(tree.nodes().size(), 1) * sizeof(rays::BvhNode);
    const std::uint64_t record_bytes = std::max<std::size_t>(tree.parts().size(), 1) * sizeof(RayInstance);
    if (!held_->top_buffer.reserve(top_bytes) || !held_->instance_buffer.reserve(record_bytes)) {
        held_->version = 0;
        return false;
    }
    buffers_.top = held_->top_buffer.handle();
    buffers_.instances = held_->instance_buffer.handle();
    list.update(buffers_.top, 0, std::span<const RayTop>(&tree.head(), 1));
    if (!tree.nodes().empty()) list.update(buffers_.top, sizeof(RayTop), tree.nodes());
    if (!tree.parts().empty()) list.update(buffers_.instances, 0, tree.parts());
    report_.instances_written = true;
    return true;
}

void RayScene::count() {
    report_.bytes = held_->mesh_bytes + held_->top_buffer.bytes() + held_->instance_buffer.bytes();
    report_.host_bytes = held_->trees.counts().bytes + held_->instances.bytes() + held_->masks.words().size_bytes();
    report_.triangles = held_->trees.counts().triangles;
    report_.instances = held_->instances.instances();
}

}  // namespace gnomon::visibility
