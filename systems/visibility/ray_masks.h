#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/assets/mesh_library.h"
#include "engine/rays/mesh_bvh.h"

namespace gnomon::visibility {

/// What shaders need of masked materials, as words of one buffer: a RayMask per material in use, texture coordinates of
/// the triangles of meshes that have any, and the textures' alpha at their finest level, a byte a texel.
class RayMasks {
public:
    explicit RayMasks(const assets::MeshLibrary& library) : library_(&library) {}

    /// A triangle of a tree as shaders read it: `mask` and `spare` name words of this buffer, `triangle` counts from
    /// `first_triangle` on. Adds what is not there yet.
    rays::BvhTriangle placed(const rays::BvhTriangle& triangle, std::uint32_t mesh, std::uint32_t first_triangle);

    std::span<const std::uint32_t> words() const { return words_; }

private:
    static constexpr std::uint32_t kUnset = ~0u;
    std::uint32_t material(std::uint32_t index);
    std::uint32_t texels_of(std::int32_t texture);
    std::uint32_t uvs_of(std::uint32_t mesh);

    const assets::MeshLibrary* library_;
    std::vector<std::uint32_t> words_;
    std::vector<std::uint32_t> materials_, textures_, uvs_;  // first word of each material's, texture's, mesh's; kUnset
};

}  // namespace gnomon::visibility
