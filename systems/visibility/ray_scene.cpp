#include "systems/visibility/ray_scene.h"

#include <algorithm>
#include <bit>
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

/// Makes a buffer with these values, of one element if there are none. `grows`: with room to a power of two, if the
/// device has it.
template <class T>
bool start(gl::Device& device, DeviceArrays& arrays, const char* label, std::vector<T>& values, bool grows) {
    static_assert(sizeof(T) % gl::kTexelBytes == 0);
    const auto used = static_cast<std::uint32_t>(values.size());
    const auto make = [&](std::uint32_t places) {
        values.resize(places);
        const gl::BufferDesc desc{label, values.size() * sizeof(T), gl::BufferUse::updated, true};
        return device.create_buffer(desc, std::as_bytes(std::span(values))).handle;
    };
    gl::BufferHandle made{};
    if (grows) made = make(std::bit_ceil(std::max(used, DeviceArrays::kLeastPlaces)));
    if (!made) made = make(std::max(used, 1u));
    arrays.put(0, {label, sizeof(T), true, made});
    arrays.start(static_cast<std::uint32_t>(values.size()), used, true);
    return static_cast<bool>(made);
}

}  // namespace

RayScene::State::State(gl::Device& device, const assets::MeshLibrary& library)
    : trees(library),
      masks(library),
      top_buffer(device, "ray tree of instances", true),
      instance_buffer(device, "ray instances", true) {}

/// Lets go of the meshes' buffers; submitted() frees them.
void RayScene::free_meshes() {
    nodes_.drop(0);
    triangles_.drop(0);
    masks_.drop();
    buffers_ = {};
}

void RayScene::release() {
    free_meshes();
    submitted(true);
    state_.reset();
    report_ = {};
    calls_ = 0;
    retry_ = {};
    forgotten_ = false;
}

void RayScene::submitted(bool executed) {
    nodes_.submitted();
    triangles_.submitted();
    masks_.submitted();
    forgotten_ |= !executed;
}

void RayScene::name_buffers() {
    buffers_.nodes = nodes_.buffer(0);
    buffers_.triangles = triangles_.buffer(0);
    buffers_.masks = masks_.handle();
}

bool RayScene::update(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list) {
    if (!retry_.due(++calls_)) return false;
    if (!state_) state_.emplace(device_, gpu.library());
    state_->trees.update(scene);
    const bool is_streaming = gpu.library().version != 0;
    const bool has_all = is_streaming || state_->placed_trees == state_->trees.counts().trees;
    const bool made = buffers_.nodes && !forgotten_ && has_all;
    report_.meshes_written = 0;
    report_.instances_written = false;
    bool ready = made || make_meshes(scene, gpu);
    Followed followed = Followed::same;
    if (ready && made && is_streaming) followed = follow_meshes(scene, gpu, list);
    ready = ready && followed != Followed::failed;
    if (ready && made) rewrite_bent(scene, gpu, list);
    ready = ready && write_instances(scene, !made || followed == Followed::changed, list);
    if (!ready) free_meshes();
    if (!ready) retry_.failed(calls_);
    if (ready) forgotten_ = false;
    count();
    return ready;
}

/// Appends a mesh's triangles by slot, as shaders read them.
void RayScene::take_triangles(const GpuScene& gpu, std::uint32_t mesh) {
    const std::uint32_t first = gpu.mesh(mesh).first_index / 3;
    for (rays::BvhTriangle triangle : state_->trees.tree(mesh)->triangles()) {
        if (triangle.mask != rays::kOpaque) {
            const RayMasks::Place place = state_->masks.place(mesh, triangle.triangle, triangle.mask);
            triangle.mask = place.mask;
            triangle.spare = place.uvs;
        }
        triangle.triangle += first;
        state_->scratch.push_back(triangle);
    }
}

/// Uploads all meshes' trees, one after the other.
bool RayScene::make_meshes(const SceneSnapshot& scene, const GpuScene& gpu) {
    free_meshes();
    submitted(true);  // no list of this frame names them
    const assets::MeshLibrary& library = gpu.library();
    const bool is_streaming = library.version != 0;
    state_->places.assign(library.meshes.size(), {});
    state_->taken.assign(library.meshes.size(), {});
    state_->placed_trees = state_->trees.counts().trees;
    if (is_streaming) state_->masks = RayMasks(library);
    state_->scratch.clear();
    std::vector<rays::BvhNode> nodes;
    for (std::uint32_t mesh = 0; mesh < library.meshes.size(); ++mesh) {
        const rays::MeshBvh* tree = state_->trees.tree(mesh);
        if (!tree || tree->nodes().empty()) continue;
        note_place(scene, gpu, mesh, static_cast<std::uint32_t>(nodes.size()),
                   static_cast<std::uint32_t>(state_->scratch.size()));
        nodes.insert(nodes.end(), tree->nodes().begin(), tree->nodes().end());
        nodes.resize(std::size_t{state_->places[mesh].first_node} + state_->taken[mesh].nodes);
        take_triangles(gpu, mesh);
    }
    const std::span<const std::uint32_t> words = state_->masks.words();
    const bool has_trees = start(device_, nodes_, "ray trees of meshes", nodes, is_streaming) &&
                           start(device_, triangles_, "ray triangles", state_->scratch, is_streaming);
    const bool has_all = has_trees && (words.empty() || masks_.make(words, !is_streaming));
    state_->masks.forget_changes();
    state_->scratch = {};
    name_buffers();
    return has_all;
}

/// Writes down where a mesh's tree lies, and what it is of.
void RayScene::note_place(const SceneSnapshot& scene, const GpuScene& gpu, std::uint32_t mesh, std::uint32_t first_node,
                          std::uint32_t first_slot) {
    const rays::MeshBvh& tree = *state_->trees.tree(mesh);
    const bool bends = gpu.library().meshes[mesh].deformer != nullptr;
    state_->places[mesh] = {first_node, static_cast<std::uint32_t>(tree.nodes().size()), first_slot, tree.box(), {}};
    if (!bends) state_->places[mesh].tree = tree.nodes();
    state_->taken[mesh] = {most_nodes(tree, bends), static_cast<std::uint32_t>(tree.triangles().size()),
                           state_->trees.mesh_version(mesh), pose_version(scene, mesh)};
}

/// Frees the places of trees of removed and replaced meshes. Returns whether there were any.
bool RayScene::take_away_changed() {
    bool any = false;
    for (std::uint32_t mesh = 0; mesh < state_->places.size(); ++mesh) {
        MeshTreePlace& place = state_->places[mesh];
        Taken& taken = state_->taken[mesh];
        const bool stays = state_->trees.tree(mesh) && taken.mesh_version == state_->trees.mesh_version(mesh);
        if (place.nodes == 0 || stays) continue;
        nodes_.give(place.first_node, taken.nodes);
        triangles_.give(place.first_slot, taken.triangles);
        state_->masks.forget(mesh);
        place = {};
        taken = {};
        any = true;
    }
    return any;
}

/// Follows meshes that came and went.
RayScene::Followed RayScene::follow_meshes(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list) {
    const std::size_t meshes = gpu.library().meshes.size();
    state_->places.resize(meshes);
    state_->taken.resize(meshes);
    const bool any_went = take_away_changed();
    bool any_came = false;
    for (std::uint32_t mesh = 0; mesh < meshes; ++mesh) {
        const rays::MeshBvh* tree = state_->trees.tree(mesh);
        if (!tree || tree->nodes().empty() || state_->places[mesh].nodes > 0) continue;
        if (!place_mesh(scene, gpu, mesh, list)) return Followed::failed;
        any_came = true;
    }
    nodes_.shrink(list);
    triangles_.shrink(list);
    if (!masks_.follow(state_->masks, list)) return Followed::failed;
    state_->placed_trees = state_->trees.counts().trees;
    name_buffers();
    return any_went || any_came ? Followed::changed : Followed::same;
}

/// Takes places for a mesh's tree, and writes it. Returns false without room.
bool RayScene::place_mesh(const SceneSnapshot& scene, const GpuScene& gpu, std::uint32_t mesh, gl::CommandList& list) {
    const rays::MeshBvh& tree = *state_->trees.tree(mesh);
    const std::uint32_t nodes = most_nodes(tree, gpu.library().meshes[mesh].deformer != nullptr);
    const std::uint32_t first_node = nodes_.take(nodes, true, list);
    const std::uint32_t first_slot = triangles_.take(static_cast<std::uint32_t>(tree.triangles().size()), true, list);
    if (first_node == DeviceArrays::kNone || first_slot == DeviceArrays::kNone) return false;
    note_place(scene, gpu, mesh, first_node, first_slot);
    state_->scratch.clear();
    take_triangles(gpu, mesh);
    nodes_.write(0, first_node, tree.nodes(), list);
    triangles_.write(0, first_slot, std::span<const rays::BvhTriangle>(state_->scratch), list);
    ++report_.meshes_written;
    return true;
}

void RayScene::rewrite_bent(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list) {
    for (const PoseItem& pose : scene.poses) {
        const rays::MeshBvh* tree = state_->trees.tree(pose.mesh);
        if (!tree || tree->nodes().empty() || state_->taken[pose.mesh].pose_version == pose.version) continue;
        MeshTreePlace& place = state_->places[pose.mesh];
        place.nodes = static_cast<std::uint32_t>(tree->nodes().size());
        place.box = tree->box();
        state_->taken[pose.mesh].pose_version = pose.version;
        state_->scratch.clear();
        take_triangles(gpu, pose.mesh);
        list.update(buffers_.nodes, std::uint64_t{place.first_node} * sizeof(rays::BvhNode), tree->nodes());
        list.update(buffers_.triangles, std::uint64_t{place.first_slot} * sizeof(rays::BvhTriangle),
                    std::span<const rays::BvhTriangle>(state_->scratch));
        ++report_.meshes_written;
    }
}

/// Returns true if all instances are as when the upper level was written.
bool RayScene::stand_still(const SceneSnapshot& scene) const {
    if (scene.version == 0 || scene.version == state_->version) return scene.version != 0;
    const bool all_are_named =
        scene.version == state_->version + 1 && scene.list_version != 0 && scene.list_version == state_->list_version;
    return all_are_named && scene.changed_instances.empty();
}

/// Writes the upper level. `all`: the device's contents are unknown.
bool RayScene::write_instances(const SceneSnapshot& scene, bool all, gl::CommandList& list) {
    const bool still = !all && stand_still(scene);
    if (still) state_->version = scene.version;
    if (still) return true;
    const bool same = !all && scene.list_version != 0 && scene.list_version == state_->list_version;
    InstanceTree& tree = state_->instances;
    tree.update(scene, state_->places, same);
    state_->version = scene.version;
    state_->list_version = scene.list_version;
    const std::uint64_t top_bytes =
        sizeof(RayTop) + std::max<std::size_t>(tree.nodes().size(), 1) * sizeof(rays::BvhNode);
    const std::uint64_t record_bytes = std::max<std::size_t>(tree.parts().size(), 1) * sizeof(RayInstance);
    if (!state_->top_buffer.reserve(top_bytes) || !state_->instance_buffer.reserve(record_bytes)) {
        state_->version = 0;
        return false;
    }
    buffers_.top = state_->top_buffer.handle();
    buffers_.instances = state_->instance_buffer.handle();
    list.update(buffers_.top, 0, std::span<const RayTop>(&tree.head(), 1));
    if (!tree.nodes().empty()) list.update(buffers_.top, sizeof(RayTop), tree.nodes());
    if (!tree.parts().empty()) list.update(buffers_.instances, 0, tree.parts());
    report_.instances_written = true;
    return true;
}

void RayScene::count() {
    report_.bytes = nodes_.bytes() + triangles_.bytes() + masks_.bytes() + state_->top_buffer.bytes() +
                    state_->instance_buffer.bytes();
    report_.host_bytes = state_->trees.counts().bytes + state_->instances.bytes() + state_->masks.words().size_bytes();
    report_.triangles = state_->trees.counts().triangles;
    report_.instances = state_->instances.instances();
}

}  // namespace gnomon::visibility
