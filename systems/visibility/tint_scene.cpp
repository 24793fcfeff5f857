#include "systems/visibility/tint_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/math/finite.h"
#include "engine/math/projection.h"

namespace gnomon::visibility {
namespace {

constexpr std::uint32_t kUnset = ~0u;

template <class T>
void append_words(const T& value, std::vector<std::uint32_t>& words) {
    static_assert(sizeof(T) % 4 == 0);
    const std::size_t at = words.size();
    words.resize(at + sizeof(T) / 4);
    std::memcpy(&words[at], &value, sizeof value);
}

bool has_translucent(const GpuScene& gpu, std::uint32_t mesh) {
    if (gpu.engine_mesh(mesh)) return false;
    const GpuScene::MeshRange& range = gpu.mesh(mesh);
    for (std::uint32_t s = 0; s < range.submesh_count; ++s)
        if (gpu.material(gpu.submesh(range.first_submesh + s).material).transmits) return true;
    return false;
}

/// Returns the middle of all translucent casters' bounds, from which positions keep most bits.
glm::dvec3 middle_of(const SceneSnapshot& scene, const GpuScene& gpu) {
    math::Aabb all;
    for (const InstanceItem& item : scene.instances)
        if (item.casts && has_translucent(gpu, item.mesh)) all = math::merged(all, item.bounds_ws);
    const glm::dvec3 middle = math::centre(all);
    return math::is_finite(glm::vec3(middle)) ? middle : glm::dvec3(0.0);
}

rays::Box box_of(const TintTriangle& t) {
    return {glm::min(t.a, glm::min(t.b, t.c)), glm::max(t.a, glm::max(t.b, t.c))};
}

}  // namespace

void TintScene::release() {
    buffer_.release();
    triangles_ = {};
    shading_ = {};
    words_ = {};
    material_places_ = {};
    texture_places_ = {};
    written_ = false;
}

/// Returns the place of a texture's texels in shading_.
std::uint32_t TintScene::texels_of(const assets::MeshLibrary& library, std::int32_t texture) {
    if (texture < 0 || static_cast<std::size_t>(texture) >= library.textures.size()) return kUnset;
    const auto index = static_cast<std::size_t>(texture);
    const assets::Texture& source = library.textures[index];
    const std::size_t texels = std::size_t{source.width} * source.height;
    if (texels == 0 || source.rgba.size() < 4 * texels) return kUnset;
    texture_places_.resize(library.textures.size(), kUnset);
    if (texture_places_[index] == kUnset) {
        texture_places_[index] = static_cast<std::uint32_t>(shading_.size());
        shading_.resize(shading_.size() + texels);
        std::memcpy(&shading_[texture_places_[index]], source.rgba.data(), 4 * texels);
    }
    return texture_places_[index];
}

/// Returns the place of a material in shading_.
std::uint32_t TintScene::material_of(const GpuScene& gpu, std::uint32_t material) {
    const assets::MeshLibrary& library = gpu.library();
    material_places_.resize(library.materials.size(), kUnset);
    if (material_places_[material] != kUnset) return material_places_[material];
    const assets::Material& source = library.materials[material];
    TintMaterial record;
    for (int i = 0; i < 4; ++i) record.base_colour[i] = source.base_colour[i] > 0.0f ? source.base_colour[i] : 0.0f;
    for (int i = 0; i < 3; ++i) record.through[i] = gpu.material(material).transmission[i];
    record.blended = source.alpha_mode == assets::AlphaMode::blend ? 1 : 0;
    record.cutoff = source.alpha_mode == assets::AlphaMode::mask ? source.alpha_cutoff : -1.0f;
    record.metallic = source.metallic > 0.0f ? std::min(source.metallic, 1.0f) : 0.0f;
    record.texels = texels_of(library, source.base_colour_texture);
    if (record.texels != kUnset) {
        const assets::Texture& texture = library.textures[static_cast<std::size_t>(source.base_colour_texture)];
        record.width = texture.width;
        record.height = texture.height;
        record.wrap_u = static_cast<std::uint32_t>(texture.wrap_u);
        record.wrap_v = static_cast<std::uint32_t>(texture.wrap_v);
        record.linear = texture.linear_filter ? 1 : 0;
    }
    material_places_[material] = static_cast<std::uint32_t>(shading_.size());
    append_words(record, shading_);
    return material_places_[material];
}

void TintScene::add_instance(const InstanceItem& item, const GpuScene& gpu, const glm::dvec3& anchor_ws_m) {
    const GpuScene::MeshRange& range = gpu.mesh(item.mesh);
    const GpuScene::MeshShape shape = gpu.shape(item.mesh);
    const std::vector<glm::vec4>& colours = gpu.library().meshes[item.mesh].colours;
    const glm::dvec3 offset = item.translation_ws_m - anchor_ws_m;
    for (std::uint32_t s = 0; s < range.submesh_count; ++s) {
        const GpuScene::SubmeshRange& submesh = gpu.submesh(range.first_submesh + s);
        if (!gpu.material(submesh.material).transmits) continue;
        const std::uint32_t material = material_of(gpu, submesh.material),
                            first = submesh.first_index - range.first_index;
        for (std::uint32_t i = first; i + 2 < first + submesh.index_count; i += 3) {
            TintTriangle t;
            glm::vec3* const corners[] = {&t.a, &t.b, &t.c};
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = (*shape.indices)[i + corner];
                const assets::Vertex& source = (*shape.vertices)[vertex];
                *corners[corner] = glm::vec3(item.basis * glm::dvec3(source.position_ms) + offset);
                t.uv[2 * corner] = source.uv.x;
                t.uv[2 * corner + 1] = source.uv.y;
                for (int channel = 0; channel < 4; ++channel)
                    t.colours[4 * corner + static_cast<std::uint32_t>(channel)] =
                        vertex < colours.size() ? colours[vertex][channel] : 1.0f;
            }
            t.layers = item.cast_layers;
            t.material = material;
            if (math::is_finite(t.a) && math::is_finite(t.b) && math::is_finite(t.c)) triangles_.push_back(t);
        }
    }
}

/// Gathers the words of the buffer: head, nodes, triangles by slot, materials and texels.
void TintScene::gather(const SceneSnapshot& scene, const GpuScene& gpu) {
    triangles_.clear();
    shading_.clear();
    material_places_.clear();
    texture_places_.clear();
    words_.clear();
    const glm::dvec3 anchor_ws_m = middle_of(scene, gpu);
    for (const InstanceItem& item : scene.instances)
        if (item.casts && !item.drawable.by_depth && has_translucent(gpu, item.mesh))
            add_instance(item, gpu, anchor_ws_m);
    std::vector<rays::Box> boxes;
    TintHead head;
    for (const TintTriangle& t : triangles_) {
        boxes.push_back(box_of(t));
        for (const glm::vec3& end : {boxes.back().min, boxes.back().max})
            for (int axis = 0; axis < 3; ++axis) head.reach_m = std::max(head.reach_m, std::abs(end[axis]));
    }
    const rays::Bvh tree = rays::build_bvh(boxes);
    const math::TwoFloat3 anchor = math::split(anchor_ws_m);
    head.anchor_high = anchor.high;
    head.anchor_low = anchor.low;
    head.nodes = static_cast<std::uint32_t>(tree.nodes.size());
    head.triangles = static_cast<std::uint32_t>(sizeof(TintHead) / 4 + tree.nodes.size() * (sizeof(rays::BvhNode) / 4));
    append_words(head, words_);
    for (const rays::BvhNode& node : tree.nodes) append_words(node, words_);
    const std::uint32_t shading =
        head.triangles + static_cast<std::uint32_t>(tree.items.size() * (sizeof(TintTriangle) / 4));
    // Places in shading_ become places in the buffer.
    for (const std::uint32_t place : material_places_) {
        if (place == kUnset) continue;
        std::uint32_t& texels = shading_[place + offsetof(TintMaterial, texels) / 4];
        if (texels != kUnset) texels += shading;
    }
    for (const std::uint32_t item : tree.items) {
        TintTriangle t = triangles_[item];
        t.material += shading;
        append_words(t, words_);
    }
    words_.insert(words_.end(), shading_.begin(), shading_.end());
}

bool TintScene::update(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list) {
    const bool same =
        written_ && scene.version != 0 && scene.version == version_ && gpu.library().version == library_version_;
    if (same) return true;
    gather(scene, gpu);
    if (!buffer_.reserve(words_.size() * sizeof(std::uint32_t))) {
        written_ = false;
        return false;
    }
    list.update(buffer_.handle(), 0, std::span<const std::uint32_t>(words_));
    version_ = scene.version;
    library_version_ = gpu.library().version;
    written_ = true;
    return true;
}

}  // namespace gnomon::visibility
