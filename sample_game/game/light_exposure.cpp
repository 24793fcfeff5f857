#include "sample_game/game/light_exposure.h"

#include <algorithm>

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
    : library_(library_of(scene)), queries_(*library_) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const assets::Node& node = scene.nodes[i];
        const bool out = std::find(left_out.begin(), left_out.end(), static_cast<std::int32_t>(i)) != left_out.end();
        if (out || node.mesh == assets::kNone || !node.casts_shadow) continue;
        const auto mesh = static_cast<std::uint32_t>(node.mesh);
        if (scene.meshes[mesh].deformer || scene.meshes[mesh].indices.empty()) continue;
        nodes_.push_back(i);
        queries_.add_caster(mesh);
    }
}

void Occluders::place(std::span<const WorldTransform> poses) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) queries_.place(i, poses[nodes_[i]]);
}

void Occluders::ask(const Light& lamp, const WorldTransform& at, std::span<const LitPlace> places,
                    std::span<float> shares) {
    queries_.ask(lamp, at, places, shares);
}

}  // namespace gnomon::game
