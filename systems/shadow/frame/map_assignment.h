#pragma once
#include <cstdint>

#include "engine/gl/device.h"

namespace gnomon::shadow {

/// Content hashes of a view's map. They cover matrices, size, and casters in drawing order with versions and faces.
/// Never 0. Two different maps share a hash with probability 2^-64.
struct ContentSignature {
    std::uint64_t still = 0;      // with static casters only
    std::uint64_t all = 0;        // with all casters
    std::uint64_t placement = 0;  // without casters
};

/// Textures of a conservative shadow map (FilterStorage::conservative_bounds) beside its depths
/// (docs/explanation/exact_proof.md).
struct BoundsMaps {
    gl::TextureHandle second{};  // depths of the second layer: the next triangles behind
    gl::TargetHandle second_target{};
    gl::TextureHandle bounds{};  // depth of the nearest silhouette edge, and depth slope bound
    gl::TargetHandle bounds_target{};
    gl::BufferHandle ends{};  // occluder pyramid; FilterStorage::occluder_pyramid only
};

/// Textures of a view of a filter with FilterRow::moments beside its depths.
struct PrefilteredMaps {
    gl::TextureHandle moments{};
    gl::TargetHandle target{};
    gl::TextureHandle scratch{};  // result of the blur's first pass; {0}: there is only one pass
    gl::TargetHandle scratch_target{};
};

/// Struct 5. Textures of a view's map. texture {0}: it has none in this frame.
struct MapAssignment {
    gl::TextureHandle texture{};
    gl::TargetHandle target{};
    /// Triangle that each texel shows (FilterStorage::triangle_ids). With conservative bounds: one layer into which all
    /// views are drawn in turn. Otherwise {0}.
    gl::TextureHandle triangles{};
    std::uint32_t triangle_bits = 0;  // TriangleReferences::triangle_bits of that texture
    BoundsMaps sheets;
    PrefilteredMaps prefiltered;
    std::uint32_t size_px = 0;
    ContentSignature content;  // hashes of the content that the layer should have after this frame
};

}  // namespace gnomon::shadow
