#include "systems/shadow/request/filter_choice.h"

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/accuracy_target.h"

namespace gnomon::shadow {
namespace {

/// Returns true if the stored choice was made for this target. Compares bit for bit, because the setting was stored
/// unchanged.
bool is_for_target(const FilterHistory& held, double target_px) {
    return held.target_px <= target_px && held.target_px >= target_px;
}

bool is_seen_as_before(const FilterHistory& held, double seen_px) {
    return held.seen_px <= seen_px && held.seen_px >= seen_px;
}

}  // namespace

bool leaves_filter(const LightItem& light) {
    const LightShadow& shadow = light.shadow;
    const ShadowTuning& tuning = light.tuning;
    if (shadow.filter != ShadowFilter::automatic || !(shadow.max_error_px > 0.0f)) return false;
    const bool sun = light_facts(light.kind).parallel;
    const bool given = shadow.resolution_px > 0 || tuning.projection.near_m != 0.0f || tuning.projection.far_m != 0.0f;
    const bool apart =
        sun && (tuning.cascades.fit == ShadowFit::stable || tuning.projection.kind == LightProjection::perspective);
    return !given && !apart && tuning.bias.mode == BiasMode::automatic;
}

ShadowFilter filter_to_fit(const LightItem& light, const FilterHistory* held) {
    if (light.shadow.filter != ShadowFilter::automatic) return light.shadow.filter;
    const bool exact = held && held->filter == kExactFilter && leaves_filter(light);
    return exact ? kExactFilter : kDefaultFilter;
}

ShadowFilter chosen_filter(const FilterHistory& held, double usual_px, double target_px) {
    const bool comes_back = held.filter == kExactFilter && is_for_target(held, target_px);
    const double most_px = comes_back ? target_px / kFilterHysteresis : target_px;
    return meets_target(usual_px, most_px) ? kDefaultFilter : kExactFilter;
}

bool is_trial_due(const FilterHistory& held, double target_px) {
    return !is_for_target(held, target_px) || held.frames == 1 || held.passed > 0;
}

bool comes_back(const FilterHistory& held, double target_px) {
    return !is_for_target(held, target_px) || held.passed + 1 >= kFilterPasses;
}

FilterHistory exact_history(const FilterHistory& held, double usual_px, bool passed, double seen_px, double target_px) {
    FilterHistory next{kExactFilter, target_px, usual_px, seen_px, 0, 0};
    if (passed)
        next.passed = held.passed + 1;
    else if (held.filter == kExactFilter && held.frames > 1)
        next.frames = held.frames - 1;
    else if (held.filter != kExactFilter || held.passed > 0 || !is_seen_as_before(held, seen_px))
        next.frames = kFilterFrames;
    return next;
}

}  // namespace gnomon::shadow
