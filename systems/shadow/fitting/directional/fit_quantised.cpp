#include <algorithm>
#include <cmath>

#include "systems/shadow/fitting/directional/cascade_fit.h"
#include "systems/shadow/fitting/light_space_extents.h"
#include "systems/shadow/fitting/size_steps.h"

namespace gnomon::shadow {
namespace {

/// One side of the box, along one of the light's axes, metres from the world's origin.
struct Side {
    double low = 0.0, size = 0.0;
};

/// Hysteresis of one size, in steps. A size more than `patience` too large is replaced after some time, more than
/// `most` at once. The next size is `headroom` larger than needed.
struct Holding {
    int patience, most, headroom;
};

/// Hysteresis of the sides. A turning camera lengthens and shortens them all the time, and each change shows. Over a
/// roll by 300 degrees they vary by six to twelve steps (tests/stability/camera_paths_test.cpp).
constexpr Holding kAcross{6, 12, 2};
/// Hysteresis of the depth range. A generous range costs no sharpness: its rounding is a hundred-thousandth of a texel.
constexpr Holding kAlong{12, 12, 4};

/// Steps beyond the headroom that a size keeps in a frame in which another size changes anyway.
constexpr int kSpare = 2;

/// Returns the step for `needed`: the last frame's by hysteresis, or another.
int held_step_for(double needed, const ViewFitHistory& previous, int previous_step, const Holding& holding,
                  Stepping stepping, ViewFitHistory& next) {
    const int closest = step_at_or_above(needed);
    if (!previous.used) return closest;
    const bool together = stepping == Stepping::together;
    const int least = closest + (together ? holding.headroom : 0);
    const int most = closest + (together ? holding.headroom + kSpare : holding.most);
    const bool stays = previous_step >= least && (stepping == Stepping::larger || previous_step <= most);
    next.too_large = next.too_large || (stays && previous_step > closest + holding.patience);
    return stays ? previous_step : closest + holding.headroom;
}

/// Range of what is seen along one axis.
struct CoordinateRange {
    double low, high;
};

/// Place of a side in the last frame.
struct LastPlace {
    bool used;
    double low;
    int step;
};

/// Places a side around `seen`, on a grid of `grid` times its size. `seen` must be at most `room` of the size. Keeps
/// the last frame's place while that contains `seen`.
Side hold(const CoordinateRange& seen, double room, double grid, const LastPlace& last, int step) {
    Side side{0.0, step_size(step)};
    const auto [low, high] = seen;
    const double margin = 0.5 * (1.0 - room) * side.size - 0.5 * grid * side.size;
    const bool holds = last.low + margin <= low && last.low + side.size - margin >= high;
    if (last.used && step == last.step && holds) {
        side.low = last.low;
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

    const ViewFitHistory& previous = input.light.previous.views[input.index];
    ViewFitHistory& next = input.light.next.views[input.index];
    const double texel = 1.0 / input.light.request.map.resolution_px;
    const double room = 1.0 / with_border(1.0, input.light) - texel;  // one texel less, for the grid
    glm::dvec3 low, size;
    next.too_large = false;
    for (int axis = 0; axis < 2; ++axis) {
        const CoordinateRange span{seen.low[axis], seen.high[axis]};
        const int previous_step = previous.extent_step[axis];
        int& step = next.extent_step[axis];
        step = held_step_for((span.high - span.low) / room, previous, previous_step, kAcross, input.stepping, next);
        const Side side = hold(span, room, texel, {previous.used, previous.low[axis], previous_step}, step);
        low[axis] = next.low[axis] = side.low;
        size[axis] = side.size;
    }
    constexpr double kDepthRoom = 1.0 - 4.0 * kDepthSlack;
    const CoordinateRange span{seen.low.z, seen.high.z};
    next.far_step =
        held_step_for((span.high - span.low) / kDepthRoom, previous, previous.far_step, kAlong, input.stepping, next);
    const Side depth =
        hold(span, kDepthRoom, kDepthSlack, {previous.used, previous.near_m, previous.far_step}, next.far_step);
    low.z = next.near_m = depth.low;
    size.z = depth.size;
    next.used = true;

    box.axes = input.basis;
    place(input, input.basis * (low + 0.5 * size), glm::dvec2(size), size.z, box);
    return true;
}

}  // namespace gnomon::shadow
