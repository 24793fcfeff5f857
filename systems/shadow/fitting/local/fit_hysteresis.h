#pragma once
#include "systems/shadow/fitting/size_steps.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/projection/perspective_range.h"
#include "systems/shadow/projection/perspective_view.h"

/// Hysteresis of a local light's views. Sizes are rounded up to steps, and the last choice stays while it is good
/// enough. Any `previous` is safe: a choice always contains what is needed. `next` receives the choice.
namespace gnomon::shadow {

/// Steps of 2^(1/4) by which a kept choice may exceed the closest one: a factor of 1.41. An object that bobs across a
/// step then moves nothing.
inline constexpr int kHoldSteps = 2;

/// The same for a near plane that costs nothing: a factor of 16. It moves an octave farther than needed. So an
/// approaching object moves it seldom, and an object that moves to and fro only once.
inline constexpr int kHoldFreeNearSteps = 4 * kStepsPerOctave, kFreeNearHeadroom = kStepsPerOctave;

/// Returns whether near may lie anywhere before what is seen. Reversed floats resolve a share of the distance, so
/// results of comparing them depend on nothing else. False where a filter's width in texels follows from near.
bool is_near_free(const ShadowRequest& request);

/// Returns the range of perspective_range(), rounded outward to steps. near >= far only if nothing lies before the
/// light.
PerspectiveRange held_range(double nearest_m, double farthest_m, bool near_is_free, const ViewFitHistory& previous,
                            ViewFitHistory& next);

/// A fixed anchor that a range lies around: its distance from the light, and the least distance to both of its sides.
struct RangeAnchor {
    double at_m = 0.0, least_m = 0.0;
};

/// Does the same with distances to both sides of a fixed anchor. For a far anchor, steps of
/// the distance itself would be much longer than what is seen. Equals held_range() where the near side reaches the
/// light.
PerspectiveRange held_range_around(const RangeAnchor& anchor, double nearest_m, double farthest_m, bool near_is_free,
                                   const ViewFitHistory& previous, ViewFitHistory& next);

/// Returns `needed` within `full`, rounded outward: each side becomes a step, placed on sixteenths of itself. A side
/// that would not be a step shorter than the full one stays full. None is cropped below a 64th of it: there a float
/// matrix still places a texel of an 8192 px map to a sixteenth.
TangentRectangle held_rectangle(const TangentRectangle& needed, const TangentRectangle& full,
                                const ViewFitHistory& previous, ViewFitHistory& next);

}  // namespace gnomon::shadow
