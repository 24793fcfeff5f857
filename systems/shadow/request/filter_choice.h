#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/request/filter_table.h"

/// Which filter a light has that names none (ShadowFilter::automatic): kUsualFilter, unless somebody said how far off
/// edges may be (LightShadow::max_error_px above 0) and no map that the light may have keeps that; then kKeepingFilter,
/// which errs by nothing and asks rays for it. What is not said asks for no more than the usual filter's maps give:
/// rays cost one and a half to three times as much (docs/cost.md).
///
/// A cheaper row is never chosen. The bound of `hard` at one size is that of kUsualFilter (error_bound.h), so that
/// it would always do, and who says how far off edges may be would get stairs where he had edges. Budgets take it
/// (Grant::plain).
///
/// The choice is held: a light comes back once the usual filter's largest maps err by kFilterPatience less than they
/// may, in kFilterPasses frames in a row; kFilterFrames lie between one look that fails and the next.
namespace gnomon::shadow {

inline constexpr ShadowFilter kKeepingFilter = ShadowFilter::exact;

/// By how much less the usual filter has to err than it may, for a light to come back to it: sqrt(2), as for a number
/// of cascades. From where it does to where it no longer keeps the word a camera has to come nearer by as much.
inline constexpr double kFilterPatience = 1.4142135623730951;

/// Fits of the usual filter that only tell whether it would do are made so seldom: a second at 60 Hz.
inline constexpr std::uint32_t kFilterFrames = 60;

/// In so many frames in a row they have to do before a light comes back: half a second, longer than a glance aside, in
/// which all else is seen.
inline constexpr std::uint32_t kFilterPasses = 30;

/// Whether the filter is the contract's to choose: neither it nor the size of the maps is named, and what would be
/// looked up instead shows the same shadows. It would not under an eye of a sun's own, a depth range that is given, or
/// a bias by hand, on whose being automatic the prediction rests.
bool leaves_filter(const LightItem& light);

/// The filter that the light's request starts from; `held`: what its contract chose, null if it is new.
ShadowFilter filter_to_fit(const LightItem& light, const HeldFilter* held);

/// What the light is to have, where the largest maps of the usual filter err by `usual_px`. NaN: they do not keep it.
ShadowFilter chosen_filter(const HeldFilter& held, double usual_px, double wished_px);

/// Whether a light that has kKeepingFilter is due to try the usual one.
bool is_trial_due(const HeldFilter& held, double wished_px);

/// Whether a light comes back after a trial that passed: another word is taken at once.
bool comes_back(const HeldFilter& held, double wished_px);

/// What is held of kKeepingFilter after a frame in which its maps err by `seen_px`, `usual_px` being what the usual
/// one's were last found to err by, and `passed` whether that was in this frame and would have done.
HeldFilter held_keeping(const HeldFilter& held, double usual_px, bool passed, double seen_px, double wished_px);

}  // namespace gnomon::shadow
