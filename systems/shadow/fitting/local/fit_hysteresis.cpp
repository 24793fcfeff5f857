#include "systems/shadow/fitting/local/fit_hysteresis.h"

#include <algorithm>
#include <cmath>

#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {
namespace {

struct Side {
    double low, high;
    double size() const { return high - low; }
};

constexpr double kPlaces = 16.0;           // grid steps per length of a cropped side
constexpr double kLeastCrop = 1.0 / 64.0;  // least cropped side, as a share of the full one

/// Returns the smallest step, on its own grid, that contains `needed`; `full` if it is no smaller.
Side closest(const Side& needed, const Side& full) {
    const double least = std::max(needed.size(), full.size() * kLeastCrop);
    const double size = step_size(step_at_or_above(least * (kPlaces / (kPlaces - 1.0))));
    if (!(size < full.size())) return full;
    const double place = size / kPlaces;
    const double low = std::clamp(std::floor(needed.low / place) * place, full.low, full.high - size);
    return {low, low + size};
}

Side hold(const Side& needed, const Side& full, bool used, const Side& previous) {
    const Side choice = closest(needed, full);
    const bool holds = previous.low <= needed.low && previous.high >= needed.high;
    return used && holds && previous.size() <= choice.size() * step_size(kHoldSteps) ? previous : choice;
}

}  // namespace

bool is_near_free(const ShadowRequest& request) {
    return request.map.depth_format == DepthFormat::d32f && !filter_row(request.map.filter).moments &&
           !needs_distances(request.map.filtering) && !(request.map.filtering.spread_m > 0.0f);
}

PerspectiveRange held_range(double nearest_m, double farthest_m, bool near_is_free, const ViewFitHistory& previous,
                            ViewFitHistory& next) {
    const PerspectiveRange tight = perspective_range(nearest_m, farthest_m);
    if (!(tight.near_m < tight.far_m) || !std::isfinite(tight.far_m)) return tight;
    next.far_step = hold_above(tight.far_m, previous.used, previous.far_step, kHoldSteps);
    next.near_step =
        hold_below(tight.near_m, previous.used, previous.near_step, near_is_free ? kHoldFreeNearSteps : kHoldSteps);
    if (near_is_free && previous.used && next.near_step < previous.near_step) next.near_step -= kFreeNearHeadroom;
    return {step_size(next.near_step), step_size(next.far_step)};
}

PerspectiveRange held_range_around(const RangeAnchor& anchor, double nearest_m, double farthest_m, bool near_is_free,
                                   const ViewFitHistory& previous, ViewFitHistory& next) {
    constexpr double kSlack = 1.0 + 1.0 / (1 << 10);  // as in perspective_range()
    const double before_m = kSlack * std::max(anchor.at_m - nearest_m, anchor.least_m);
    const double behind_m = kSlack * std::max(farthest_m - anchor.at_m, anchor.least_m);
    if (!(before_m < anchor.at_m) || !std::isfinite(behind_m))
        return held_range(nearest_m, farthest_m, near_is_free, previous, next);
    next.near_step = hold_above(before_m, previous.used, previous.near_step, kHoldSteps);
    next.far_step = hold_above(behind_m, previous.used, previous.far_step, kHoldSteps);
    const double near_m = anchor.at_m - step_size(next.near_step);
    if (!(near_m > kLeastNear * anchor.at_m)) return held_range(nearest_m, farthest_m, near_is_free, previous, next);
    return {near_m, anchor.at_m + step_size(next.far_step)};
}

TangentRectangle held_rectangle(const TangentRectangle& needed, const TangentRectangle& full,
                                const ViewFitHistory& previous, ViewFitHistory& next) {
    TangentRectangle chosen;
    for (int axis = 0; axis < 2; ++axis) {
        const Side side = hold({needed.low[axis], needed.high[axis]}, {full.low[axis], full.high[axis]}, previous.used,
                               {previous.low[axis], previous.high[axis]});
        chosen.low[axis] = next.low[axis] = side.low;
        chosen.high[axis] = next.high[axis] = side.high;
    }
    return chosen;
}

}  // namespace gnomon::shadow
