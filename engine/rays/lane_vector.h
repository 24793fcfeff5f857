#pragma once
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "engine/rays/ray_packet.h"

/// Vectors of four lanes, in a form that GCC and clang both accept. Compilers vectorise a plain loop over lanes only
/// while it has no branch.
namespace gnomon::rays {

static_assert(kVectorLanes == 4);
/// Returns the number of vectors up to the last of the lanes.
inline std::size_t vectors_of(Lanes lanes) {
    return (static_cast<std::size_t>(std::bit_width(lanes)) + kVectorLanes - 1) / kVectorLanes;
}
using FloatVector = float __attribute__((vector_size(16)));
using LaneVector = std::int32_t __attribute__((vector_size(16)));  // all bits of a lane set, or none

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

/// Returns the marked lanes of a vector as bits.
inline Lanes lanes_of(LaneVector marked, std::size_t vector) {
    const LaneVector bits = marked & LaneVector{1, 2, 4, 8};
    return static_cast<Lanes>(bits[0] | bits[1] | bits[2] | bits[3]) << (vector * kVectorLanes);
}

}  // namespace gnomon::rays
