#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/assets/mesh_library.h"

namespace gnomon {

/// Matches RayMask in shaders/ray_tracing/alpha_mask.glsl: nine words of its buffer.
struct RayMask {
    float cutoff = 0.0f, alpha = 1.0f;
    std::uint32_t texels = ~0u;  // word of the first, four to a word; ~0: alpha alone decides
    std::uint32_t width = 0, height = 0;
    std::uint32_t wrap_u = 0, wrap_v = 0;  // assets::TextureWrap
    std::uint32_t linear = 0;  // bit 0: filtered; bit 1: triangles have their corners' alpha behind their coordinates
    float chord_texel = 0.0f;  // mean_chord_texel(); infinite where alpha alone decides
};
static_assert(sizeof(RayMask) == 36);

/// How wide what a mask leaves is on the average: texels from edge to edge along rows and columns, the texture
/// repeated; 0 where it leaves nothing, infinite where it cuts nothing. By texels, whose alpha times `alpha` is at
/// least `cutoff`.
float mean_chord_texel(const assets::Texture& texture, float alpha, float cutoff);

/// What shaders need of masked materials, as words of one buffer: a RayMask per material in use, texture coordinates of
/// the triangles of meshes that have any, and the textures' alpha at their finest level, a byte a texel.
class RayMasks {
public:
    explicit RayMasks(const assets::MeshLibrary& library) : library_(&library) {}

    /// Words of a masked triangle: of its material's RayMask, and of its texture coordinates.
    struct Place {
        std::uint32_t mask = 0, uvs = 0;
    };
    /// Of a triangle of a mesh, which has that material. Adds what is not there yet.
    Place place(std::uint32_t mesh, std::uint32_t triangle, std::uint32_t material);

    std::span<const std::uint32_t> words() const { return words_; }

private:
    static constexpr std::uint32_t kUnset = ~0u;
    std::uint32_t mask_of(std::uint32_t material, bool coloured);
    std::uint32_t texels_of(std::int32_t texture);
    std::uint32_t uvs_of(std::uint32_t mesh);

    const assets::MeshLibrary* library_;
    std::vector<std::uint32_t> words_;
    std::vector<std::uint32_t> materials_, textures_, uvs_;  // first word of each material's, texture's, mesh's; kUnset
    std::vector<std::uint32_t> coloured_;                    // as materials_, on meshes with colours
};

}  // namespace gnomon
