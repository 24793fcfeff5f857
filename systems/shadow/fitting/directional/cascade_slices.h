#pragma once
#include <array>

#include "systems/shadow/request/light_kinds.h"

/// View distances that each cascade serves, and view distances that its map contains.
namespace gnomon::shadow {

/// View distances of one cascade, along the first camera's view, metres.
struct CascadeSlice {
    double holds_from_m = 0.0, holds_to_m = 0.0;   // contained in its map: more than it serves
    double air_from_m =
        0.0;  // the same for air, which may begin nearer than the cascades' first end; else holds_from_m
    double fades_from_m = 0.0, serves_to_m = 0.0;  // here it starts to fade into the next; here the next serves alone
};
using CascadeSlices = std::array<CascadeSlice, kMaxCascades>;

/// Computes the slices; the first request.view_count are filled. Splits of maps that are kept move over many frames
/// (split_transition.h). Meanwhile maps contain what is served at both ends of that move, so that they need not follow.
CascadeSlices cascade_slices(const FitInput& input);

}  // namespace gnomon::shadow
