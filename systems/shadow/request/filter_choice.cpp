#include "systems/shadow/request/filter_choice.h"

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/accuracy_target.h"

namespace gnomon::shadow {
namespace {

/// Returns true if the stored choice was made for this target. Compares bit for bit, because the setting was stored
/// unchanged.
bool is_of_word(const HeldFilter& held, double wished_px) {
    return held.wished_px <= wished_px && held.wished_px >= wished_px;
}

bool is_seen_as_before(const HeldFilter& held, double seen_px) {
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

ShadowFilter filter_to_fit(const LightItem& light, const HeldFilter* held) {
    if (light.shadow.filter != ShadowFilter::automatic) return light.shadow.filter;
    const bool keeping = held && held->filter == kKeepingFilter && leaves_filter(light);
    return keeping ? kKeepingFilter : kUsualFilter;
}

ShadowFilter chosen_filter(const HeldFilter& held, double usual_px, double wished_px) {
    const bool comes_back = held.filter == kKeepingFilter && is_of_word(held, wished_px);
    const double most_px = comes_back ? wished_px / kFilterPatience : wished_px;
    return keeps_contract(usual_px, most_px) ? kUsualFilter : kKeepingFilter;
}

bool is_trial_due(const HeldFilter& held, double wished_px) {
    return !is_of_word(held, wished_px) || held.frames == 1 || held.passed > 0;
}

bool comes_back(const HeldFilter& held, double wished_px) {
    return !is_of_word(held, wished_px) || held.passed + 1 >= kFilterPasses;
}

HeldFilter held_keeping(const HeldFilter& held, double usual_px, bool passed, double seen_px, double wished_px) {
    HeldFilter next{kKeepingFilter, wished_px, usual_px, seen_px, 0, 0};
    if (passed)
        next.passed = held.passed + 1;
    else if (held.filter == kKeepingFilter && held.frames > 1)
        next.frames = held.frames - 1;
    else if (held.filter != kKeepingFilter || held.passed > 0 || !is_seen_as_before(held, seen_px))
        next.frames = kFilterFrames;
    return next;
}

}  // namespace gnomon::shadow
