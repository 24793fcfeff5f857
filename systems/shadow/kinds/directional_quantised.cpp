#include <algorithm>
#include <cmath>

#include "systems/shadow/kinds/cascade_fit.h"
#include "systems/shadow/kinds/extents.h"
#include "systems/shadow/kinds/steps.h"

namespace gnomon::shadow {
namespace {

/// One side of the box, along one of the light's axes, from the world's origin.
struct Side {
    double low = 0.0, size = 0.0;
};

/// How long a size is kept, in steps: given up when it is more than `patience` too large; what follows is `headroom`
/// larger than it need be.
struct Holding {
    int patience, headroom;
    bool steps_too = false;  // it is a good frame for a step
};

/// A turning camera lengthens and shortens a slice's sides all the time, and each change of a size shows.
constexpr Holding kAcross{6, 1};
/// A depth range costs no sharpness: its rounding is a hundred-thousandth of a texel. So it may be generous.
constexpr Holding kAlong{12, 4};

/// Steps beyond the headroom that stay in a frame in which another size steps anyway.
constexpr int kSpare = 2;

/// The step for `needed`, and whether it is held.
int held_step_for(double needed, bool used, int held_step, const Holding& holding) {
    const int closest = step_at_or_above(needed);
    if (!used) return closest;
    const int least = closest + (holding.steps_too ? holding.headroom : 0);
    const int most = closest + (holding.steps_too ? holding.headroom + kSpare : holding.patience);
    return held_step >= least && held_step <= most ? held_step : closest + holding.headroom;
}

/// From low to high, not longer than `room` of a step, on parts of `grid` of it; the held one where that still holds
/// it.
Side hold(double low, double high, double room, double grid, const Holding& holding, bool used, double held_low,
          int held_step, int& step) {
    step = held_step_for((high - low) / room, used, held_step, holding);
    Side side{0.0, step_size(step)};
    const double margin = 0.5 * (1.0 - room) * side.size - 0.5 * grid * side.size;
    const bool holds = held_low + margin <= low && held_low + side.size - margin >= high;
    if (used && step == held_step && holds) {
        side.low = held_low;
    } else {
        const double part = grid * side.size;
        side.low = std::round((0.5 * (low + high) - 0.5 * side.size) / part) * part;
    }
    return side;
}

}  // namespace

bool fit_quantised(const CascadeInput& input, OrthographicBox& box) {
    Extents seen = extents_along(input.basis, input.points_ws);
    const glm::dvec3 extent = seen.high - seen.low;
    const double largest = std::max({extent.x, extent.y, extent.z});
    if (!(largest > 0.0) || !std::isfinite(largest)) return false;
    const glm::dvec3 widened = glm::max(glm::dvec3(0.0), glm::dvec3(largest * kLeastExtent) - extent) * 0.5;
    seen.low -= widened;
    seen.high += widened;

    const HeldView& held = input.light.held.views[input.index];
    HeldView& next = input.light.next.views[input.index];
    const double texel = 1.0 / input.light.demand.resolution_px;
    const double room = 1.0 / with_border(1.0, input.light) - texel;  // a texel of it for the grid
    glm::dvec3 low, size;
    Holding across = kAcross, along = kAlong;
    across.steps_too = along.steps_too = input.steps_too;
    for (int axis = 0; axis < 2; ++axis) {
        const Side side = hold(seen.low[axis], seen.high[axis], room, texel, across, held.used, held.low[axis],
                               held.extent_step[axis], next.extent_step[axis]);
        low[axis] = next.low[axis] = side.low;
        size[axis] = side.size;
    }
    const Side depth = hold(seen.low.z, seen.high.z, 1.0 - 4.0 * kDepthSlack, kDepthSlack, along, held.used,
                            held.near_m, held.far_step, next.far_step);
    low.z = next.near_m = depth.low;
    size.z = depth.size;
    next.used = true;

    box.axes = input.basis;
    place(input, input.basis * (low + 0.5 * size), glm::dvec2(size), size.z, box);
    return true;
}

}  // namespace gnomon::shadow
