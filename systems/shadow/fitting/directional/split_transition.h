#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/fit_history.h"

/// Splits between cascades that move over many frames, so that no movement is visible.
namespace gnomon::shadow {

/// Split distances in transition, never falling. `at_m` lies between the others, and equals `to_m` at the end.
struct SplitTransition {
    CascadeSplitDistances at_m{}, from_m{}, to_m{};  // now; at the start; at the end
};

/// Greatest change of a static point's blend between two cascades per frame. An eighth of a shadow's strength, 3 bits,
/// is not seen to appear.
inline constexpr double kMostFade = 0.125;

/// Returns the distance at which cascade i - 1 starts to fade into cascade i, complete at ends_m[i]; 1 <= i <=
/// cascades.
double fade_start(const CascadeSplitDistances& ends_m, std::uint32_t i, double blend);

/// Moves the splits of `count` cascades toward the wanted ones. In one frame a static point changes its blend by at
/// most kMostFade, camera motion included, unless that alone is more. Without history, without a band to fade in, or
/// after a leap of the camera across whole bands, the wanted splits are used at once.
SplitTransition glide(const CascadeSplitDistances& wanted_m, std::uint32_t count, double blend,
                      const ConsumerItem& consumer, const SplitHistory& previous, SplitHistory& next);

}  // namespace gnomon::shadow
