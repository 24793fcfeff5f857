#include "systems/shadow/request/filter_choice.h"

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/accuracy_target.h"

namespace gnomon::shadow {
namespace {

/// Returns true if the stored choice was made for these targets. Compares bit for bit, because they were stored
/// unchanged.
bool is_for(const FilterHistory& held, const AccuracyTargets& targets) { return held.targets == targets; }

bool is_seen_as_before(const FilterHistory& held, double seen_px) {
    return held.seen_px <= seen_px && held.seen_px >= seen_px;
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

ShadowFilter filter_to_fit(const LightItem& light, const FilterHistory* held) {
    if (light.shadow.filter != ShadowFilter::automatic) return light.shadow.filter;
    const bool exact = held && held->filter == kExactFilter && leaves_filter(light);
    return exact ? kExactFilter : usual_filter(light.kind);
}

ShadowFilter chosen_filter(const FilterHistory& held, const MapAccuracy& usual, const AccuracyTargets& targets) {
    const bool comes_back = held.filter == kExactFilter && is_for(held, targets);
    return meets_targets(usual, targets, comes_back ? 1.0 / kFilterHysteresis : 1.0) ? kDefaultFilter : kExactFilter;
}

bool is_trial_due(const FilterHistory& held, const AccuracyTargets& targets) {
    return !is_for(held, targets) || held.frames == 1 || held.passed > 0;
}

bool comes_back(const FilterHistory& held, const AccuracyTargets& targets) {
    return !is_for(held, targets) || held.passed + 1 >= kFilterPasses;
}

FilterHistory exact_history(const FilterHistory& held, const MapAccuracy& usual, bool passed, double seen_px,
                            const AccuracyTargets& targets) {
    FilterHistory next{kExactFilter, targets, usual, seen_px, 0, 0};
    if (passed)
        next.passed = held.passed + 1;
    else if (held.filter == kExactFilter && held.frames > 1)
        next.frames = held.frames - 1;
    else if (held.filter != kExactFilter || held.passed > 0 || !is_seen_as_before(held, seen_px))
        next.frames = kFilterFrames;
    return next;
}

}  // namespace gnomon::shadow
