#pragma once
#include <cstdint>

#include "engine/gl/device.h"

namespace gnomon::shadow {

/// Hash of everything that decides a view's depth picture: matrices, size, casters in the order in which they are
/// drawn, their versions and faces. Never 0. Two different pictures share a number with probability 2^-64.
struct ContentSignature {
    std::uint64_t still = 0;      // of its static casters alone
    std::uint64_t all = 0;        // of all casters
    std::uint64_t placement = 0;  // without any caster
};

/// What a view of FilterStorage::conservative_bounds has beside its depths (docs/exact.md).
struct BoundsMaps {
    gl::TextureHandle second{};  // depths of the next triangles behind
    gl::TargetHandle second_target{};
    gl::TextureHandle bounds{};  // where surfaces end, and how far they depart from their depths
    gl::TargetHandle bounds_target{};
    gl::BufferHandle ends{};  // occluder pyramid, of FilterStorage::occluder_pyramid
};

/// What a view of a filter with FilterRow::moments has beside its depths.
struct PrefilteredMaps {
    gl::TextureHandle moments{};
    gl::TargetHandle target{};
    gl::TextureHandle scratch{};  // between the two passes of the blur; {0}: one pass alone
    gl::TargetHandle scratch_target{};
};

/// Struct 5. Where a view's map lies. texture {0}: it has none in this frame.
struct MapAssignment {
    gl::TextureHandle texture{};
    gl::TargetHandle target{};
    /// Which triangle each texel shows (FilterStorage::triangle_ids). With bounds one layer that all views draw
    /// into, one after the other. Else {0}.
    gl::TextureHandle triangles{};
    BoundsMaps sheets;
    PrefilteredMaps prefiltered;
    std::uint32_t size_px = 0;
    ContentSignature content;  // what the layer is to hold
};

}  // namespace gnomon::shadow
