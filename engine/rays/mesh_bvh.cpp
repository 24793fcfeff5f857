#include "engine/rays/mesh_bvh.h"

#include <cmath>

#include "engine/math/finite.h"

namespace gnomon::rays {
namespace {

/// Computes the triangle's box; empty if a corner is not finite.
Box box_of(const BvhTriangle& t) {
    if (!math::is_finite(t.a) || !math::is_finite(t.b) || !math::is_finite(t.c)) return {};
    return {glm::min(t.a, glm::min(t.b, t.c)), glm::max(t.a, glm::max(t.b, t.c))};
}

std::vector<Box> boxes_of(std::span<const BvhTriangle> triangles) {
    std::vector<Box> boxes;
    boxes.reserve(triangles.size());
    for (const BvhTriangle& triangle : triangles) boxes.push_back(box_of(triangle));
    return boxes;
}

}  // namespace

MeshBvh::MeshBvh(const assets::Mesh& mesh, std::span<const assets::Vertex> vertices,
                 const std::vector<assets::Material>& materials, MeshPart which) {
    triangles_.reserve(mesh.indices.size() / 3);
    for (const assets::Submesh& part : mesh.submeshes) {
        const assets::AlphaMode mode = materials[part.material].alpha_mode;
        const bool is_translucent = assets::transmits(materials[part.material]);
        const bool is_wanted = which == MeshPart::shown ? mode != assets::AlphaMode::blend
                                                        : is_translucent == (which == MeshPart::translucent);
        if (!is_wanted) continue;
        BvhTriangle triangle;
        if (mode == assets::AlphaMode::mask || which == MeshPart::translucent) triangle.mask = part.material;
        for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3) {
            triangle.triangle = (part.first_index + i) / 3;
            triangles_.push_back(triangle);
        }
    }
    place(mesh, vertices);
    if (!mesh.deformer)
        std::erase_if(triangles_, [](const BvhTriangle& triangle) { return is_empty(box_of(triangle)); });
    build();
}

void MeshBvh::place(const assets::Mesh& mesh, std::span<const assets::Vertex> vertices) {
    for (BvhTriangle& triangle : triangles_) {
        const std::uint32_t* corner = &mesh.indices[std::size_t{3} * triangle.triangle];
        triangle.a = vertices[corner[0]].position_ms;
        triangle.b = vertices[corner[1]].position_ms;
        triangle.c = vertices[corner[2]].position_ms;
    }
}

void MeshBvh::build() {
    Bvh bvh = build_bvh(boxes_of(triangles_));
    std::vector<BvhTriangle> by_slot;
    by_slot.reserve(triangles_.size());
    for (const std::uint32_t item : bvh.items) by_slot.push_back(triangles_[item]);
    triangles_ = std::move(by_slot);
    nodes_ = std::move(bvh.nodes);
    built_cost_ = cost().steps();
    ++builds_;
}

void MeshBvh::move(const assets::Mesh& mesh, std::span<const assets::Vertex> vertices) {
    place(mesh, vertices);
    refit_bvh(nodes_, boxes_of(triangles_));
    if (cost().steps() > kLooseGrowth * built_cost_) build();
}

}  // namespace gnomon::rays
