#pragma once
#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

/// Near and far plane of a reversed perspective view, metres: near before all casters and receivers, far behind all
/// receivers.
struct PerspectiveRange {
    double near_m = 0.0, far_m = 0.0;
};

/// Least near plane as a share of far: reversed D32F keeps its relative precision down to there.
inline constexpr double kLeastNear = 1.0 / (1 << 20);

/// Returns the range around [nearest_m, farthest_m], widened by 2^-10 against rounding. The arguments are metres along
/// the axis; they may be 0 or negative where objects surround the light. near never falls below far * kLeastNear. Depth
/// clamping still draws casters between the light and the near plane. near >= far only if nothing lies before the
/// light.
inline PerspectiveRange perspective_range(double nearest_m, double farthest_m) {
    constexpr double kSlack = 1.0 / (1 << 10);
    const double far_m = farthest_m * (1.0 + kSlack);
    return {std::min(std::max(nearest_m * (1.0 - kSlack), far_m * kLeastNear), far_m * (1.0 - kSlack)), far_m};
}

}  // namespace gnomon::shadow
