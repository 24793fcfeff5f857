#include "sample_game/game/occluders.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace gnomon::game {
namespace {

constexpr std::uint32_t kTrianglesPerLeaf = 4;
constexpr std::size_t kDeepest = 64;  // halving 2^32 triangles takes fewer levels

/// Whether from + t along meets the box for a t of 0 to 1.
bool meets(const math::Aabb& box, const glm::dvec3& from, const glm::dvec3& along) {
    double enter = 0.0, leave = 1.0;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        if (along[axis] == 0.0) {
            if (from[axis] < box.min[axis] || from[axis] > box.max[axis]) return false;
            continue;
        }
        const double a = (box.min[axis] - from[axis]) / along[axis], b = (box.max[axis] - from[axis]) / along[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

}  // namespace

math::Aabb Occluders::Triangle::box() const {
    const glm::dvec3 b = corner + edge_1, c = corner + edge_2;
    return {glm::min(corner, glm::min(b, c)), glm::max(corner, glm::max(b, c))};
}

Occluders::Occluders(const assets::SceneData& scene, std::span<const std::int32_t> left_out) {
    add_masks(scene);
    for (const assets::Mesh& mesh : scene.meshes) add_shape(mesh);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const assets::Node& node = scene.nodes[i];
        const bool out = std::find(left_out.begin(), left_out.end(), static_cast<std::int32_t>(i)) != left_out.end();
        if (out || node.mesh == assets::kNone || !node.casts_shadow) continue;
        const auto shape = static_cast<std::size_t>(node.mesh);
        if (scene.meshes[shape].deformer) continue;
        if (!shapes_[shape].triangles.empty()) casters_.push_back({.node = i, .shape = shape});
    }
}

void Occluders::add_masks(const assets::SceneData& scene) {
    for (const assets::Material& material : scene.materials) {
        material_blocks_.push_back(material.alpha_mode != assets::AlphaMode::blend);
        mask_of_material_.push_back(assets::kNone);
        if (material.alpha_mode != assets::AlphaMode::mask || material.base_colour_texture == assets::kNone) continue;
        const assets::Texture& texture = scene.textures[static_cast<std::size_t>(material.base_colour_texture)];
        Mask mask{texture.width, texture.height, {}};
        for (std::size_t i = 3; i < texture.rgba.size(); i += 4)
            mask.opaque.push_back(static_cast<float>(texture.rgba[i]) / 255.0f * material.base_colour.a >=
                                  material.alpha_cutoff);
        mask_of_material_.back() = static_cast<std::int32_t>(masks_.size());
        masks_.push_back(std::move(mask));
    }
}

void Occluders::add_shape(const assets::Mesh& mesh) {
    Shape shape;
    for (const assets::Submesh& part : mesh.submeshes) {
        if (!material_blocks_[part.material]) continue;
        for (std::uint32_t i = part.first_index; i + 2 < part.first_index + part.index_count; i += 3) {
            std::array<assets::Vertex, 3> v;
            for (std::uint32_t k = 0; k < 3; ++k) v[k] = mesh.vertices[mesh.indices[i + k]];
            const glm::dvec3 a(v[0].position_ms);
            shape.triangles.push_back({.corner = a,
                                       .edge_1 = glm::dvec3(v[1].position_ms) - a,
                                       .edge_2 = glm::dvec3(v[2].position_ms) - a,
                                       .uvs = {glm::dvec2(v[0].uv), glm::dvec2(v[1].uv), glm::dvec2(v[2].uv)},
                                       .mask = mask_of_material_[part.material]});
        }
    }
    shape.branches.push_back({.first = 0, .count = static_cast<std::uint32_t>(shape.triangles.size())});
    if (!shape.triangles.empty()) split(shape, 0);
    shapes_.push_back(std::move(shape));
}

void Occluders::split(Shape& shape, std::uint32_t branch) {
    const auto [first, count] = std::pair(shape.branches[branch].first, shape.branches[branch].count);
    math::Aabb box;
    for (std::uint32_t i = first; i < first + count; ++i) box = math::merged(box, shape.triangles[i].box());
    shape.branches[branch].box = box;
    if (count <= kTrianglesPerLeaf) return;
    const glm::dvec3 size = box.max - box.min;
    const glm::length_t axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const auto centre = [axis](const Triangle& t) {
        const math::Aabb b = t.box();
        return b.min[axis] + b.max[axis];
    };
    const auto begin = shape.triangles.begin() + static_cast<std::ptrdiff_t>(first);
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(count / 2), begin + static_cast<std::ptrdiff_t>(count),
                     [&](const Triangle& a, const Triangle& b) { return centre(a) < centre(b); });
    const auto child = static_cast<std::uint32_t>(shape.branches.size());
    shape.branches.push_back({.first = first, .count = count / 2});
    shape.branches.push_back({.first = first + count / 2, .count = count - count / 2});
    shape.branches[branch].first = child;
    shape.branches[branch].count = 0;
    split(shape, child);
    split(shape, child + 1);
}

void Occluders::place(std::span<const WorldTransform> poses) {
    for (Caster& caster : casters_) {
        const WorldTransform& pose = poses[caster.node];
        caster.box_ws =
            math::transformed(shapes_[caster.shape].branches.front().box, pose.basis, pose.translation_ws_m);
        caster.local_from_ws = glm::inverse(pose.basis);
        caster.origin_ws_m = pose.translation_ws_m;
    }
}

/// Moeller and Trumbore 1997, both sides.
bool Occluders::crosses(const Triangle& triangle, const glm::dvec3& from, const glm::dvec3& along) const {
    const glm::dvec3 p = glm::cross(along, triangle.edge_2);
    const double determinant = glm::dot(triangle.edge_1, p);
    if (determinant == 0.0) return false;
    const glm::dvec3 to_from = from - triangle.corner;
    const double u = glm::dot(to_from, p) / determinant;
    const glm::dvec3 q = glm::cross(to_from, triangle.edge_1);
    const double v = glm::dot(along, q) / determinant, t = glm::dot(triangle.edge_2, q) / determinant;
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < 1.0)) return false;
    if (triangle.mask == assets::kNone) return true;
    const Mask& mask = masks_[static_cast<std::size_t>(triangle.mask)];
    if (mask.opaque.empty()) return true;
    const glm::dvec2 uv = triangle.uvs[0] * (1.0 - u - v) + triangle.uvs[1] * u + triangle.uvs[2] * v;
    const auto texel = [](double coordinate, std::uint32_t size) {
        const double wrapped = (coordinate - std::floor(coordinate)) * size;
        return std::min(static_cast<std::uint32_t>(wrapped), size - 1u);
    };
    return mask.opaque[std::size_t{texel(uv.y, mask.height)} * mask.width + texel(uv.x, mask.width)];
}

bool Occluders::crosses(const Shape& shape, const glm::dvec3& from, const glm::dvec3& along) const {
    std::array<std::uint32_t, kDeepest> waiting{};
    std::size_t depth = 1;
    while (depth > 0) {
        const Branch& branch = shape.branches[waiting[--depth]];
        if (!meets(branch.box, from, along)) continue;
        if (branch.count == 0) {
            waiting[depth++] = branch.first;
            waiting[depth++] = branch.first + 1;
            continue;
        }
        for (std::uint32_t i = branch.first; i < branch.first + branch.count; ++i)
            if (crosses(shape.triangles[i], from, along)) return true;
    }
    return false;
}

bool Occluders::blocked(const glm::dvec3& from_ws_m, const glm::dvec3& to_ws_m) const {
    const glm::dvec3 along_ws = to_ws_m - from_ws_m;
    return std::any_of(casters_.begin(), casters_.end(), [&](const Caster& caster) {
        return meets(caster.box_ws, from_ws_m, along_ws) &&
               crosses(shapes_[caster.shape], caster.local_from_ws * (from_ws_m - caster.origin_ws_m),
                       caster.local_from_ws * along_ws);
    });
}

}  // namespace gnomon::game
