#include <algorithm>

#include "bench/embed/host_engine.h"

namespace gnomon::bench {
namespace {

using assets::AlphaMode;

bool is_masked(const assets::Material& material) {
    return material.alpha_mode == AlphaMode::mask && material.base_colour_texture != assets::kNone;
}

/// Takes the triangles of some of a mesh's parts, all of one material where one is masked.
HostMesh taken(const assets::Mesh& mesh, std::span<const assets::Submesh> parts, const assets::MeshLibrary& library) {
    const assets::Material& material = library.materials[parts.front().material];
    HostMesh host;
    host.name = mesh.name;
    host.two_sided = material.double_sided;
    for (const assets::Vertex& vertex : mesh.vertices) host.positions_m.push_back(vertex.position_ms);
    for (const assets::Submesh& part : parts)
        host.indices.insert(host.indices.end(), mesh.indices.begin() + part.first_index,
                            mesh.indices.begin() + part.first_index + part.index_count);
    if (!is_masked(material)) return host;
    const assets::Texture& texture = library.textures[static_cast<std::size_t>(material.base_colour_texture)];
    for (const assets::Vertex& vertex : mesh.vertices) host.uvs.push_back(vertex.uv);
    host.mask_px = {texture.width, texture.height};
    for (std::size_t i = 3; i < texture.rgba.size(); i += 4) host.alpha.push_back(texture.rgba[i]);
    host.cutoff = material.alpha_cutoff;
    return host;
}

/// Adds a mesh of the library. Returns the numbers that it has become.
std::vector<std::uint32_t> add_mesh(const assets::Mesh& mesh, const assets::MeshLibrary& library, HostScene& scene) {
    std::vector<std::uint32_t> numbers;
    const auto add = [&](std::span<const assets::Submesh> parts) {
        numbers.push_back(static_cast<std::uint32_t>(scene.meshes.size()));
        scene.meshes.push_back(taken(mesh, parts, library));
    };
    const std::span<const assets::Submesh> all(mesh.submeshes);
    const auto is_plain = [&](const assets::Submesh& part) {
        return library.materials[part.material].alpha_mode == AlphaMode::opaque;
    };
    if (!all.empty() && std::all_of(all.begin(), all.end(), is_plain)) {
        add(all);
        return numbers;
    }
    for (std::size_t i = 0; i < all.size(); ++i)
        if (library.materials[all[i].material].alpha_mode != AlphaMode::blend) add(all.subspan(i, 1));
    return numbers;
}

}  // namespace

HostScene host_scene(const SceneSnapshot& snapshot, const assets::MeshLibrary& library) {
    HostScene scene;
    std::vector<std::vector<std::uint32_t>> numbers(library.meshes.size());
    std::vector<bool> is_added(library.meshes.size(), false);
    for (const InstanceItem& item : snapshot.instances) {
        if (!item.visible) continue;
        if (!is_added[item.mesh]) numbers[item.mesh] = add_mesh(library.meshes[item.mesh], library, scene);
        is_added[item.mesh] = true;
        glm::dmat4 place(item.basis);
        place[3] = glm::dvec4(item.translation_ws_m, 1.0);
        for (const std::uint32_t mesh : numbers[item.mesh])
            scene.parts.push_back({mesh, place, item.casts, item.receives});
    }
    return scene;
}

}  // namespace gnomon::bench
