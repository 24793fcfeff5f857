#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/mesh/deformer.h"
#include "engine/rays/bvh.h"
#include "gnomon/assets.h"

namespace gnomon::rays {

inline constexpr std::uint32_t kOpaque = 0xffffffffu;

/// Triangle of a tree; 48 bytes, in a shader three vec4 with an unsigned in each w.
struct BvhTriangle {
    glm::vec3 a{0.0f};
    std::uint32_t triangle = 0;  // index in the mesh: its corners are indices[3 * triangle] and the next two
    glm::vec3 b{0.0f};
    std::uint32_t mask = kOpaque;  // material that decides what a hit is: masked, or translucent; kOpaque: none
    glm::vec3 c{0.0f};
    std::uint32_t spare = 0;
};
static_assert(sizeof(BvhTriangle) == 48);

/// Triangles of a mesh that a tree has. blocking: those of opaque and masked casters, which let no light through.
/// shown: those of surfaces that pictures show as opaque: all but blended ones. translucent: those of translucent
/// casters (assets::transmits).
enum class MeshPart : std::uint8_t { blocking, shown, translucent };

/// Tree over triangles of a mesh, in mesh space. Excludes those of a rigid mesh with a corner that is not finite. A
/// deformed mesh's triangles follow its vertices, rounded to float once, as on the GPU.
class MeshBvh {
public:
    MeshBvh() = default;
    /// Builds the tree. `vertices`: current ones from assets::deform(), or the mesh's own.
    MeshBvh(const assets::Mesh& mesh, std::span<const assets::Vertex> vertices,
            const std::vector<assets::Material>& materials, MeshPart part = MeshPart::blocking);

    /// Moves the triangles to the new vertices and refits the boxes. Rebuilds the tree if walks cost kLooseGrowth times
    /// as much as when it was built.
    void move(const assets::Mesh& mesh, std::span<const assets::Vertex> vertices);

    std::span<const BvhNode> nodes() const { return nodes_; }
    std::span<const BvhTriangle> triangles() const { return triangles_; }  // by slot
    /// Returns the box around all triangles; empty without a finite triangle.
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
