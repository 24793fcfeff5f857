#pragma once
#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

/// Near and far of a reversed perspective view: near before every caster and receiver, far behind every receiver.
struct PerspectiveRange {
    double near_m = 0.0, far_m = 0.0;
};

/// Share of far below which near does not go: reversed D32F keeps its relative precision there.
inline constexpr double kLeastNear = 1.0 / (1 << 20);

/// `nearest`, `farthest`: of what matters, metres along the axis; may be 0 or negative where things surround the light.
/// near never falls below far * kLeastNear; depth clamping still draws what lies between the light and the near plane.
/// Ends keep 2^-10 of slack against rounding. Returns near >= far only if nothing lies before the light.
inline PerspectiveRange perspective_range(double nearest_m, double farthest_m) {
    constexpr double kSlack = 1.0 / (1 << 10);
    const double far_m = farthest_m * (1.0 + kSlack);
    return {std::min(std::max(nearest_m * (1.0 - kSlack), far_m * kLeastNear), far_m * (1.0 - kSlack)), far_m};
}

}  // namespace gnomon::shadow
