#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/fit_history.h"
#include "systems/shadow/request/filter_table.h"

/// Choice of the filter for ShadowFilter::automatic. It is kAreaFilter for area lights, else kDefaultFilter, unless
/// LightShadow::max_error_px or narrowest_caster_px is above 0 and no map within the light's limits meets it. Then it
/// is kExactFilter, which has no such error and loses no caster, because it traces rays. Without targets the default
/// filter's maps suffice: rays cost one and a half to three times as much (docs/results/cost.md).
///
/// A cheaper filter is never chosen here: edges would become stairs. Only budgets choose one (QualityLimits::plain).
///
/// Hysteresis: a light returns to the default filter after this filter's largest maps met the targets /
/// kFilterHysteresis in kFilterPasses consecutive frames. After a failed trial, the next one follows kFilterFrames
/// later.
namespace gnomon::shadow {

/// Filter that meets every target.
inline constexpr ShadowFilter kExactFilter = ShadowFilter::exact;

/// Hysteresis: the default filter is taken back only when its error is below the target / kFilterHysteresis. The camera
/// must move by that factor before the choice changes again. sqrt(2), as for a number of cascades.
inline constexpr double kFilterHysteresis = 1.4142135623730951;

/// Frames between trial fits of the default filter: a second at 60 Hz.
inline constexpr std::uint32_t kFilterFrames = 60;

/// Consecutive frames in which the default filter must pass: half a second at 60 Hz, because a short look aside changes
/// the visible receivers.
inline constexpr std::uint32_t kFilterPasses = 30;

/// Returns the meaning of ShadowFilter::automatic without targets.
ShadowFilter usual_filter(LightKind kind);

/// Returns true if the targets may choose the filter. Area lights have one. Then neither filter nor map size is given,
/// and either filter shows the same shadows. They would differ with a sun's own eye, a given depth range, or a manual
/// bias, because the predicted error assumes the automatic one.
bool leaves_filter(const LightItem& light);

/// Returns the filter with which the light's request starts. `previous`: last choice of the targets, null for a new
/// light.
ShadowFilter filter_to_fit(const LightItem& light, const FilterHistory* previous);

/// Chooses the filter where the largest maps of the default filter have the accuracy `usual`.
ShadowFilter chosen_filter(const FilterHistory& previous, const MapAccuracy& usual, const AccuracyTargets& targets);

/// Returns true if a light with kExactFilter is due for a trial fit of the default filter.
bool is_trial_due(const FilterHistory& previous, const AccuracyTargets& targets);

/// Returns true if a light returns to the default filter after a trial that passed. After a change of the targets it
/// does at once.
bool comes_back(const FilterHistory& previous, const AccuracyTargets& targets);

/// Computes the history of a light with kExactFilter after a frame. `seen_px`: error of its maps. `usual`:
/// accuracy of the default filter's maps at the last trial. `passed`: a trial in this frame met the targets.
FilterHistory exact_history(const FilterHistory& previous, const MapAccuracy& usual, bool passed, double seen_px,
                            const AccuracyTargets& targets);

}  // namespace gnomon::shadow
