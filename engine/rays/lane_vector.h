#pragma once
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "engine/rays/ray_packet.h"

/// Four lanes at a time, as every compiler for this project can: what a loop over lanes should become and, once it
/// holds a choice, does not.
namespace gnomon::rays {

static_assert(kVectorLanes == 4);
/// Vectors that hold any of the lanes.
inline std::size_t vectors_of(Lanes lanes) {
    return (static_cast<std::size_t>(std::bit_width(lanes)) + kVectorLanes - 1) / kVectorLanes;
}
using FloatVector = float __attribute__((vector_size(16)));
using LaneVector = std::int32_t __attribute__((vector_size(16)));  // all bits of a lane, or none

inline FloatVector load(const PerLane<float>& lanes, std::size_t vector) {
    FloatVector loaded;
    std::memcpy(&loaded, lanes.data() + vector * kVectorLanes, sizeof loaded);
    return loaded;
}

inline FloatVector lower(FloatVector a, FloatVector b) { return a < b ? a : b; }
inline FloatVector higher(FloatVector a, FloatVector b) { return a > b ? a : b; }
inline FloatVector absolute(FloatVector a) { return a < 0.0f ? -a : a; }

inline bool any(LaneVector marked) {
    std::uint64_t halves[2];
    std::memcpy(halves, &marked, sizeof halves);
    return (halves[0] | halves[1]) != 0;
}

/// Those of the lanes of a vector that are marked.
inline Lanes lanes_of(LaneVector marked, std::size_t vector) {
    const LaneVector bits = marked & LaneVector{1, 2, 4, 8};
    return static_cast<Lanes>(bits[0] | bits[1] | bits[2] | bits[3]) << (vector * kVectorLanes);
}

}  // namespace gnomon::rays
