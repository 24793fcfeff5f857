#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/fit_history.h"

/// Borders between cascades that move over many frames, so that nobody sees them move.
namespace gnomon::shadow {

/// Never falling; `at_m` lies between the others, and equals `to_m` when the way is done.
struct GlidingEnds {
    CascadeEnds at_m{}, from_m{}, to_m{};  // now; where the way began; where it leads
};

/// Three bits: nobody sees an eighth of a shadow's strength appear.
inline constexpr double kMostFade = 0.125;

/// Cascade i - 1 fades into cascade i from here to ends_m[i]; 1 <= i <= cascades.
double fade_start(const CascadeEnds& ends_m, std::uint32_t i, double blend);

/// The way of the ends of `count` cascades to those that are wanted. In one frame a point that stands still passes by
/// at most kMostFade from one cascade to the next, what the camera's own movement adds included, unless that alone is
/// more. Without history, without a band to fade in, or after a leap of the camera across whole bands, the ends are the
/// wanted ones at once.
GlidingEnds glide(const CascadeEnds& wanted_m, std::uint32_t count, double blend, const ConsumerItem& consumer,
                  const HeldSplits& held, HeldSplits& next);

}  // namespace gnomon::shadow
