#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/range_list.h"
#include "gnomon/assets.h"

namespace gnomon {

/// Masked material for rays; matches RayMask in shaders/ray_tracing/alpha_mask.glsl: nine words of its buffer.
struct RayMask {
    float cutoff = 0.0f, alpha = 1.0f;
    std::uint32_t texels = ~0u;  // first word of its texels, four to a word; ~0: alpha alone decides
    std::uint32_t width = 0, height = 0;
    std::uint32_t wrap_u = 0, wrap_v = 0;  // assets::TextureWrap
    std::uint32_t linear = 0;  // bit 0: filtered; bit 1: triangles store their corners' alpha after the coordinates
    float chord_texel = 0.0f;  // mean_chord_texel(); infinite if alpha alone decides
};
static_assert(sizeof(RayMask) == 36);

/// Computes the mean width of what a mask leaves: texels from edge to edge along rows and columns, texture repeated. 0
/// if it leaves nothing, infinite if it cuts nothing. A texel is left if its alpha times `alpha` is at least `cutoff`.
float mean_chord_texel(const assets::Texture& texture, float alpha, float cutoff);

/// Masked materials for shaders, as words of one buffer. Contents: a RayMask per material in use, texture coordinates
/// of its meshes' triangles, and the textures' alpha at their finest level, a byte per texel.
class RayMasks {
public:
    explicit RayMasks(const assets::MeshLibrary& library) : library_(&library) {}

    /// Word indices of a masked triangle: its material's RayMask, and its texture coordinates.
    struct Place {
        std::uint32_t mask = 0, uvs = 0;
    };
    /// Returns the place of a triangle's mask for a mesh and material; adds what is missing.
    Place place(std::uint32_t mesh, std::uint32_t triangle, std::uint32_t material);
    /// Frees the texture coordinates of a mesh that went or was replaced. Other words keep their places. Words of a
    /// removed material or texture are freed when another one takes its slot.
    void forget(std::uint32_t mesh);

    std::span<const std::uint32_t> words() const { return words_; }
    /// Words that were added since the last forget_changes().
    struct Change {
        std::uint32_t first = 0, count = 0;
    };
    std::span<const Change> changes() const { return changes_; }
    void forget_changes() { changes_.clear(); }

private:
    static constexpr std::uint32_t kUnset = ~0u;
    std::uint32_t mask_of(std::uint32_t material, bool coloured);
    std::uint32_t texels_of(std::int32_t texture);
    std::uint32_t uvs_of(std::uint32_t mesh);
    std::uint32_t room_for(std::size_t count);

    /// Words of a material, texture or mesh. Count 0: none.
    struct Words {
        std::uint32_t first = 0, count = 0;
        std::uint64_t version = 0;  // the library's, of the slot
    };

    const assets::MeshLibrary* library_;
    std::vector<std::uint32_t> words_;
    RangeList ranges_;                                    // places in words_
    std::vector<Change> changes_;                         // neighbours are joined
    std::vector<Words> materials_, coloured_, textures_;  // the second: of materials, for meshes with colours
    std::vector<Words> uvs_;                              // by mesh
};

}  // namespace gnomon
