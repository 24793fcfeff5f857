#include "systems/extract/poses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "gnomon/components.h"

namespace gnomon {
namespace {

/// Computes a * b, where the last row of both is 0 0 0 1.
glm::dmat4x3 product(const glm::dmat4x3& a, const glm::dmat4x3& b) {
    const glm::dmat3 basis(a[0], a[1], a[2]);
    return {basis * b[0], basis * b[1], basis * b[2], basis * b[3] + a[3]};
}

/// Fills in the joints' matrices, relative to the first joint's place. The deformed mesh is thus exact anywhere in the
/// world.
void take_joints(const ecs::Registry& registry, const Skin& skin, PoseItem& pose) {
    const auto placed = [&](std::size_t j) { return registry.get<WorldTransform>(skin.joints[j]); };
    const WorldTransform* first = skin.joints.empty() ? nullptr : placed(0);
    pose.origin_ws_m = first ? first->translation_ws_m : glm::dvec3(0.0);
    for (std::size_t j = 0; j < std::min(skin.joints.size(), skin.inverse_bind.size()); ++j) {
        const WorldTransform* world = placed(j);
        if (!world) continue;
        const glm::dmat3& b = world->basis;
        pose.joints[j] = product({b[0], b[1], b[2], world->translation_ws_m - pose.origin_ws_m}, skin.inverse_bind[j]);
    }
}

bool same_shape(const PoseItem& a, const PoseItem& b) {
    return a.skinned == b.skinned && a.joints == b.joints && a.weights == b.weights;
}

/// Bounds how far any vertex moved between two poses. Infinite if only one pose has joints.
double bend_m(const assets::Mesh& mesh, const PoseItem& before, const PoseItem& after) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const bool alike = before.skinned == after.skinned && before.joints.size() == after.joints.size();
    return alike ? assets::farthest_bend_m(mesh, before.pose(), after.pose()) : kInfinity;
}

/// Fills in the mesh's pose from the entity's components.
void take_pose(const ecs::Registry& registry, ecs::Entity entity, const assets::Mesh& mesh, PoseItem& pose) {
    const Skin* skin = registry.get<Skin>(entity);
    const MorphWeights* morph = registry.get<MorphWeights>(entity);
    const std::size_t joints = mesh.deformer->joint_bounds_ms.size();
    pose.skinned = skin != nullptr && mesh.deformer->has_skin();
    pose.origin_ws_m = glm::dvec3(0.0);
    pose.joints.assign(joints, glm::dmat4x3(1.0));
    if (pose.skinned && skin->joints.size() > joints) pose.joints.resize(skin->joints.size(), glm::dmat4x3(1.0));
    if (pose.skinned) take_joints(registry, *skin, pose);
    pose.weights.assign(mesh.deformer->targets.size(), 0.0f);
    for (std::size_t t = 0; morph && t < std::min(pose.weights.size(), morph->weights.size()); ++t)
        if (std::isfinite(morph->weights[t])) pose.weights[t] = morph->weights[t];
}

}  // namespace

void PoseExtractor::list(const ecs::Registry& registry, const assets::MeshLibrary& library, SceneSnapshot& snapshot) {
    sources_.clear();
    moves_pose_.clear();
    const auto add = [&](ecs::Entity e, const MeshRef& ref) {
        const bool bends = ref.mesh < library.meshes.size() && library.meshes[ref.mesh].deformer != nullptr;
        if (bends && (registry.has<Skin>(e) || registry.has<MorphWeights>(e))) sources_.push_back({e, ref.mesh});
    };
    registry.each<MeshRef, WorldTransform>(
        [&](ecs::Entity e, const MeshRef& ref, const WorldTransform&) { add(e, ref); });
    std::sort(sources_.begin(), sources_.end(), [](const Source& a, const Source& b) {
        return a.mesh != b.mesh ? a.mesh < b.mesh : a.entity.index < b.entity.index;
    });
    const auto same_mesh = [](const Source& a, const Source& b) { return a.mesh == b.mesh; };
    sources_.erase(std::unique(sources_.begin(), sources_.end(), same_mesh), sources_.end());
    std::vector<PoseItem> before = std::exchange(snapshot.poses, {});
    auto old = before.begin();
    const auto mark = [&](ecs::Entity e) {
        if (!registry.alive(e)) return;
        if (e.index >= moves_pose_.size()) moves_pose_.resize(e.index + std::size_t{1}, 0);
        moves_pose_[e.index] = 1;
    };
    for (const Source& source : sources_) {
        if (registry.has<MorphWeights>(source.entity)) mark(source.entity);
        if (const Skin* skin = registry.get<Skin>(source.entity))
            std::for_each(skin->joints.begin(), skin->joints.end(), mark);
        while (old != before.end() && old->mesh < source.mesh) ++old;
        PoseItem& pose = snapshot.poses.emplace_back();
        const std::uint64_t mesh_version = library.version_of(source.mesh);
        const bool same = old != before.end() && old->mesh == source.mesh && old->mesh_version == mesh_version;
        if (same) pose = std::move(*old);
        pose.mesh = source.mesh;
        pose.mesh_version = mesh_version;
    }
    update(registry, library, snapshot);
}

bool PoseExtractor::follows(std::span<const ecs::Entity> moved) const {
    return std::any_of(moved.begin(), moved.end(),
                       [&](ecs::Entity e) { return e.index < moves_pose_.size() && moves_pose_[e.index] != 0; });
}

bool PoseExtractor::depends_on(const ecs::Registry& registry, std::span<const ecs::Entity> came_or_went) const {
    const auto poses = [&](ecs::Entity e) { return registry.has<Skin>(e) || registry.has<MorphWeights>(e); };
    return follows(came_or_went) || std::any_of(came_or_went.begin(), came_or_went.end(), poses);
}

void PoseExtractor::update(const ecs::Registry& registry, const assets::MeshLibrary& library, SceneSnapshot& snapshot) {
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        PoseItem& pose = snapshot.poses[i];
        const assets::Mesh& mesh = library.meshes[pose.mesh];
        take_pose(registry, sources_[i].entity, mesh, scratch_);
        pose.origin_ws_m = scratch_.origin_ws_m;
        if (pose.version != 0 && same_shape(pose, scratch_)) continue;
        if (pose.version == 0) pose.since = snapshot.version;
        if (pose.version != 0) pose.bent_m += bend_m(mesh, pose, scratch_);
        pose.skinned = scratch_.skinned;
        pose.joints.swap(scratch_.joints);
        pose.weights.swap(scratch_.weights);
        pose.bounds_ms = assets::posed_bounds(mesh, pose.pose());
        pose.mirroring = assets::mirroring(mesh, pose.pose());
        pose.version = snapshot.version;
    }
}

}  // namespace gnomon
