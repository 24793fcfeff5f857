#include "systems/shadow/projection/depth_rounding.h"

#include <cmath>

namespace gnomon::shadow {
namespace {

// The rounding model of docs/explanation/bias.md, "Rounding". u = 2^-24.
constexpr double kUnitRoundoff = 5.9604644775390625e-8;
/// Orthographic depth in [0,1]: half a quantum of D32F (u/2) and the projection's own rounding (4u).
constexpr double kOrthographicRounding = 4.5 * kUnitRoundoff;
/// Perspective depth rounds in proportion to itself (bias/automatic.glsl adds that), and by 2u of its constant part
/// alpha.
constexpr double kAlphaRounding = 2.0 * kUnitRoundoff;

/// Rounding with an anchor before the light: of a row's products with a place, and of its constant. Each counts its
/// entry, product and sums, in the map and in the lookup.
constexpr double kProductRounding = 10.0 * kUnitRoundoff, kConstantRounding = 8.0 * kUnitRoundoff;

}  // namespace

double projection_rounding(const ShadowView& view, double reach_m) {
    if (is_parallel(view)) return kOrthographicRounding;
    if (view.pose.apex_m == 0.0) return kAlphaRounding * std::abs(view.depth.alpha);
    const double terms_m =
        kProductRounding * reach_m + kConstantRounding * std::abs(view.depth.far_m - view.pose.apex_m);
    return terms_m * std::abs(view.depth.alpha) / (view.pose.apex_m - reach_m);
}

}  // namespace gnomon::shadow
