#pragma once
#include <array>

#include "systems/shadow/request/light_kinds.h"

/// Which part of the view each cascade serves, and which part its map holds.
namespace gnomon::shadow {

/// Distances along the first consumer's view, metres.
struct CascadeSlice {
    double holds_from_m = 0.0, holds_to_m = 0.0;   // what its map has to hold: more than it serves
    double fades_from_m = 0.0, serves_to_m = 0.0;  // from where it fades into the next one, from where that one serves
};
using CascadeSlices = std::array<CascadeSlice, kMaxCascades>;

/// The first request.view_count are filled. Where maps are held their borders glide (split_transition.h); while they
/// are on their way, maps hold what is served at both ends of it, so that they need not follow.
CascadeSlices cascade_slices(const FitInput& input);

}  // namespace gnomon::shadow
