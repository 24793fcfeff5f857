#include "sample_game/game/light_exposure.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "systems/extract/drawable_basis.h"
#include "systems/extract/scene_tree.h"

namespace gnomon::game {
namespace {

/// Copies what queries read: meshes, materials and the textures of masks.
std::shared_ptr<const assets::MeshLibrary> library_of(const assets::SceneData& scene) {
    auto library = std::make_shared<assets::MeshLibrary>();
    library->meshes = scene.meshes;
    library->materials = scene.materials;
    library->textures.resize(scene.textures.size());
    for (const assets::Material& material : scene.materials) {
        if (material.alpha_mode != assets::AlphaMode::mask || material.base_colour_texture < 0) continue;
        const auto texture = static_cast<std::size_t>(material.base_colour_texture);
        library->textures[texture] = scene.textures[texture];
    }
    return library;
}

}  // namespace

Occluders::Occluders(const assets::SceneData& scene, std::span<const std::int32_t> left_out)
    : library_(library_of(scene)) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const assets::Node& node = scene.nodes[i];
        const bool out = std::find(left_out.begin(), left_out.end(), static_cast<std::int32_t>(i)) != left_out.end();
        if (out || node.mesh == assets::kNone || !node.casts_shadow) continue;
        const auto mesh = static_cast<std::uint32_t>(node.mesh);
        if (scene.meshes[mesh].deformer || scene.meshes[mesh].indices.empty()) continue;
        nodes_.push_back(i);
        scene_.instances.push_back({.mesh = mesh});
    }
    scene_.list_version = scene_.version = 1;
}

void Occluders::place(std::span<const WorldTransform> poses) {
    const bool first = !has_tree(scene_);
    scene_.changed_instances.clear();
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        const WorldTransform& pose = poses[nodes_[i]];
        InstanceItem& item = scene_.instances[i];
        if (!first && item.basis == pose.basis && item.translation_ws_m == pose.translation_ws_m) continue;
        const std::optional<glm::dmat3> basis = drawable_basis(pose.basis);
        item.basis = basis.value_or(pose.basis);
        item.translation_ws_m = pose.translation_ws_m;
        item.bounds_ws = math::transformed(library_->meshes[item.mesh].bounds_ms, item.basis, pose.translation_ws_m);
        item.casts = basis.has_value();
        scene_.changed_instances.push_back(i);
    }
    if (first) return build_tree(scene_);
    if (scene_.changed_instances.empty()) return;
    ++scene_.version;
    refit_tree(scene_);
}

void Occluders::ask(const LightItem& lamp, std::span<const visibility::Place> places, std::span<float> shares) {
    if (!queries_) queries_ = std::make_unique<Queries>(*library_);
    queries_->queries.ask(scene_, lamp, places, {}, shares);
}

}  // namespace gnomon::game
