#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/gl/gl45_objects.h"

/// Textures that are ranges of layers of shared arrays (TextureDesc::shared). Private to the executor.
namespace gnomon::gl {

/// An array of layers that textures of one size and format share. It lives as long as any of them does.
struct SharedArray {
    std::uint32_t texture = 0;  // id in GlObjects::textures
    std::vector<bool> used;     // per layer
};

/// Returns the number of layers of a new array, for a texture of `desc`. `others`: layers of the arrays that are full.
std::uint32_t shared_array_layers(const TextureDesc& desc, std::uint32_t others, std::uint32_t most_layers);

/// Returns the first of `count` unused layers in a row; the number of layers: there are none.
std::uint32_t find_layers(const SharedArray& array, std::uint32_t count);

class SharedArrays {
public:
    /// Makes a texture as a view of layers of an array. Makes the array where no array has room: its id is `next_id`,
    /// which grows.
    Made<GlTexture> make(const TextureDesc& desc, std::uint32_t most_layers, GlObjects& objects,
                         std::uint32_t& next_id);
    /// Frees the layers of a texture that is deleted, and their array if it was the last. Others are left alone.
    void release(const GlTexture& texture, GlObjects& objects);

private:
    std::vector<SharedArray> arrays_;
};

}  // namespace gnomon::gl
