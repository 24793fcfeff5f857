#pragma once
#include "systems/shadow/fitting/size_steps.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/frame/shadow_request.h"
#include "systems/shadow/projection/perspective_range.h"
#include "systems/shadow/projection/perspective_view.h"

/// Hysteresis of a local light's views: what is needed is rounded to steps, and what was chosen last stays as long as
/// it is good enough. Any `held` is safe; a choice always holds what is needed. `next` takes the choice.
namespace gnomon::shadow {

/// A held choice may be this many steps (of 2^(1/4)) larger than the closest one: a factor of 1.41. An object that
/// bobs across a step then moves nothing.
inline constexpr int kHoldSteps = 2;

/// The same of a near plane that costs nothing: a factor of 16. What comes nearer than anything did moves it by an
/// octave more than it need, so that a thing on its way to the light moves it seldom, and one that goes to and fro but
/// once.
inline constexpr int kHoldFreeNearSteps = 4 * kStepsPerOctave, kFreeNearHeadroom = kStepsPerOctave;

/// Whether near may be anywhere before what is seen: reversed floats tell depths apart by a share of the distance, and
/// results of comparing them hang on nothing else. Not where a filter's width in texels follows from near.
bool is_near_free(const ShadowRequest& request);

/// The range of perspective_range(), rounded outward to steps. near >= far only if nothing lies before the light.
PerspectiveRange held_range(double nearest_m, double farthest_m, bool near_is_free, const HeldView& held,
                            HeldView& next);

/// The same as distances to both sides of an anchor that stays, none less than `least_m`: where it is far, steps of the
/// distance itself would be much longer than what is seen. As held_range() where the near side reaches the light.
PerspectiveRange held_range_around(double anchor_m, double least_m, double nearest_m, double farthest_m,
                                   bool near_is_free, const HeldView& held, HeldView& next);

/// `needed` within `full`, rounded outward: each side becomes a step, placed on sixteenths of itself. A side that would
/// not gain a step against the full one stays full. Cropped to no less than a 64th of the full side: a float matrix
/// still places a texel of an 8192 px map there to a sixteenth.
TangentRectangle held_rectangle(const TangentRectangle& needed, const TangentRectangle& full, const HeldView& held,
                                HeldView& next);

}  // namespace gnomon::shadow
