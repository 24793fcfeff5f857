#pragma once
#include <cstdint>

#include "systems/shadow/frame/triangle_references.h"

namespace gnomon::shadow {

/// Most bits of a triangle's number that share a number with the instance's: a clear's float has no more.
inline constexpr std::uint32_t kMostTriangleBits = 24;
/// Bits that have to be free before two numbers become one again: four times as many instances or triangles fit then.
inline constexpr std::uint32_t kSpareBits = 2;

/// Chooses references that hold any triangle of a scene: one number where both parts have room in it, which takes half
/// the bytes. `instances`, `triangles`: numbers of places on the device. `previous`: the last frame's choice, which
/// stays while it has room, because all maps have to be made for another one.
TriangleReferences choose_references(std::uint32_t instances, std::uint32_t triangles,
                                     const TriangleReferences& previous);

}  // namespace gnomon::shadow
