#include "systems/shadow/request/filter_choice.h"

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/accuracy_target.h"

namespace gnomon::shadow {
namespace {

/// Returns true if the stored choice was made for these targets. Compares bit for bit, because they were stored
/// unchanged.
bool is_for(const FilterHistory& previous, const AccuracyTargets& targets) { return previous.targets == targets; }

bool is_seen_as_before(const FilterHistory& previous, double seen_px) {
    return previous.seen_px <= seen_px && previous.seen_px >= seen_px;
}

}  // namespace

bool leaves_filter(const LightItem& light) {
    const LightShadow& shadow = light.shadow;
    const ShadowTuning& tuning = light.tuning;
    if (shadow.filter != ShadowFilter::automatic || targets_of(shadow) == AccuracyTargets{}) return false;
    if (light_facts(light.kind).area()) return false;
    const bool sun = light_facts(light.kind).parallel;
    const bool given = shadow.resolution_px > 0 || tuning.projection.near_m != 0.0f || tuning.projection.far_m != 0.0f;
    const bool apart =
        sun && (tuning.cascades.fit == ShadowFit::stable || tuning.projection.kind == LightProjection::perspective);
    return !given && !apart && tuning.bias.mode == BiasMode::automatic;
}

ShadowFilter usual_filter(LightKind kind) { return light_facts(kind).area() ? kAreaFilter : kDefaultFilter; }

ShadowFilter filter_to_fit(const LightItem& light, const FilterHistory* previous) {
    if (light.shadow.filter != ShadowFilter::automatic) return light.shadow.filter;
    const bool exact = previous && previous->filter == kExactFilter && leaves_filter(light);
    return exact ? kExactFilter : usual_filter(light.kind);
}

ShadowFilter chosen_filter(const FilterHistory& previous, const MapAccuracy& usual, const AccuracyTargets& targets) {
    const bool comes_back = previous.filter == kExactFilter && is_for(previous, targets);
    return meets_targets(usual, targets, comes_back ? 1.0 / kFilterHysteresis : 1.0) ? kDefaultFilter : kExactFilter;
}

bool is_trial_due(const FilterHistory& previous, const AccuracyTargets& targets) {
    return !is_for(previous, targets) || previous.frames == 1 || previous.passed > 0;
}

bool comes_back(const FilterHistory& previous, const AccuracyTargets& targets) {
    return !is_for(previous, targets) || previous.passed + 1 >= kFilterPasses;
}

FilterHistory exact_history(const FilterHistory& previous, const MapAccuracy& usual, bool passed, double seen_px,
                            const AccuracyTargets& targets) {
    FilterHistory next{kExactFilter, targets, usual, seen_px, 0, 0};
    if (passed)
        next.passed = previous.passed + 1;
    else if (previous.filter == kExactFilter && previous.frames > 1)
        next.frames = previous.frames - 1;
    else if (previous.filter != kExactFilter || previous.passed > 0 || !is_seen_as_before(previous, seen_px))
        next.frames = kFilterFrames;
    return next;
}

}  // namespace gnomon::shadow
