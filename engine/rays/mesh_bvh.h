#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/assets/mesh_library.h"
#include "engine/rays/bvh.h"

namespace gnomon::rays {

inline constexpr std::uint32_t kOpaque = 0xffffffffu;

/// 48 bytes; three vec4 with an unsigned in each w.
struct BvhTriangle {
    glm::vec3 a{0.0f};
    std::uint32_t triangle = 0;  // of the mesh: its corners are indices[3 * triangle] and the next two
    glm::vec3 b{0.0f};
    std::uint32_t mask = kOpaque;  // the material whose alpha decides, if it is masked
    glm::vec3 c{0.0f};
    std::uint32_t spare = 0;
};
static_assert(sizeof(BvhTriangle) == 48);

/// The triangles of a mesh that block light, in its own space, in a tree. Blended ones do not, nor do those of a mesh
/// at rest that are not finite. A bent mesh's are where its vertices are, rounded to float once, as the GPU has them.
class MeshBvh {
public:
    MeshBvh() = default;
    /// `vertices`: of the mesh where they are now, as assets::deform() has them; or the mesh's own.
    MeshBvh(const assets::Mesh& mesh, std::span<const assets::Vertex> vertices,
            const std::vector<assets::Material>& materials);

    /// The vertices are elsewhere. Boxes are refitted; where that has made a walk kLooseGrowth times as long as it was
    /// when the tree was built, it is built anew.
    void move(const assets::Mesh& mesh, std::span<const assets::Vertex> vertices);

    std::span<const BvhNode> nodes() const { return nodes_; }
    std::span<const BvhTriangle> triangles() const { return triangles_; }  // by slot
    /// Around all; empty without a finite triangle.
    Box box() const { return nodes_.empty() ? Box{} : Box{nodes_[0].min, nodes_[0].max}; }
    BvhCost cost() const { return cost_of(nodes_); }
    std::size_t bytes() const {
        return nodes_.capacity() * sizeof(BvhNode) + triangles_.capacity() * sizeof(BvhTriangle);
    }
    std::uint32_t builds() const { return builds_; }

    static constexpr double kLooseGrowth = 1.5;

private:
    void build();
    void place(const assets::Mesh& mesh, std::span<const assets::Vertex> vertices);

    std::vector<BvhNode> nodes_;
    std::vector<BvhTriangle> triangles_;
    double built_cost_ = 0.0;
    std::uint32_t builds_ = 0;
};

}  // namespace gnomon::rays
