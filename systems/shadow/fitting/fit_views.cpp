#include <algorithm>

#include "systems/shadow/fitting/fit_views.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/filter_choice.h"

namespace gnomon::shadow {
namespace {

/// Fit of one light with the filter that its accuracy target needs. The default filter is fitted first, because the
/// choice depends on that fit's error. Lights without a target, or limited by a budget, keep their filter.
class TargetFit {
public:
    TargetFit(const SceneSnapshot& scene, const FitInputs& inputs, std::uint32_t light, const HeldLight& held,
              FitStorage& storage, FittedViews& out)
        : scene_(scene),
          inputs_(inputs),
          light_(scene.lights[light]),
          index_(light),
          held_(held),
          choice_(out.lights[light]),
          fit_(scene, inputs, light, storage, out),
          fresh_(without_fits(held)),
          wished_px_(wished_error_px(light_.shadow)) {}

    /// Fits the light. Returns why it has no views; Reason::none: it has some.
    Reason run(HeldLight& next) {
        next.filter = leaves_filter(light_) ? held_.filter : HeldFilter{};
        const ShadowFilter filter = choice_.request.map.filter;
        if (!leaves_filter(light_) || (filter != kUsualFilter && filter != kKeepingFilter)) return fit(held_, next);
        return filter == kUsualFilter ? run_usual(next) : run_keeping(next);
    }

private:
    Reason fit(const HeldLight& held, HeldLight& next, bool recount = false) {
        const HeldFilter chosen = next.filter;
        next = held;
        const Reason reason = fit_.run(held, recount, next);
        next.filter = chosen;
        return reason;
    }
    /// Fits without history, since that belongs to another filter's maps.
    Reason fit_anew(ShadowFilter filter, HeldLight& next) {
        fit_.request_anew(request_with(scene_, choice_.request.limits.device_px, &fresh_, index_, filter));
        return fit(fresh_, next);
    }
    /// Returns the largest error of all views that are looked up, pixels.
    double worst_px() const {
        double worst = 0.0;
        for (const ShadowView& view : fit_.views())
            if (!view.lit) worst = std::max(worst, view.error.edge_px);
        return worst;
    }

    Reason run_usual(HeldLight& next) {
        const Reason reason = fit(held_, next);
        if (reason != Reason::none || !(held_.budget.grant == Grant{})) return reason;
        ShadowFilter chosen = chosen_filter(held_.filter, worst_px(), wished_px_);
        const bool turns = chosen == kKeepingFilter && held_.filter.filter != kKeepingFilter;
        if (turns && choice_.request.limits.max_views > 0) {  // another number of cascades may meet the target
            const Reason recounted = fit(held_, next, true);
            if (recounted != Reason::none) return recounted;
            chosen = chosen_filter(held_.filter, worst_px(), wished_px_);
        }
        if (chosen == kUsualFilter) {
            next.filter = {kUsualFilter, wished_px_};
            return Reason::none;
        }
        const double usual_px = worst_px();
        if (!turns || inputs_.shared_out) {  // the ray budget leaves it none, or may
            next.filter = {kKeepingFilter, wished_px_, usual_px};
            return Reason::none;
        }
        const Reason kept = fit_anew(kKeepingFilter, next);
        keep(usual_px, false, next);
        return kept;
    }

    Reason run_keeping(HeldLight& next) {
        double usual_px = held_.filter.usual_px;
        bool passed = false;
        if (is_trial_due(held_.filter, wished_px_)) {
            const ShadowRequest own = choice_.request;
            const Reason reason = fit_anew(kUsualFilter, next);
            if (reason == Reason::none) {
                usual_px = worst_px();
                passed = chosen_filter(held_.filter, usual_px, wished_px_) == kUsualFilter;
            }
            if (passed && comes_back(held_.filter, wished_px_)) next.filter = {kUsualFilter, wished_px_};
            if (next.filter.filter == kUsualFilter && !inputs_.shared_out) return reason;
            fit_.request_anew(own);
        }
        const Reason reason = fit(held_, next);
        choice_.default_filter_error_px = usual_px;
        if (next.filter.filter == kKeepingFilter) keep(usual_px, passed, next);
        return reason;
    }

    void keep(double usual_px, bool passed, HeldLight& next) {
        next.filter = held_keeping(held_.filter, usual_px, passed, worst_px(), wished_px_);
        choice_.default_filter_error_px = usual_px;
    }

    const SceneSnapshot& scene_;
    const FitInputs& inputs_;
    const LightItem& light_;
    std::uint32_t index_;
    const HeldLight& held_;
    FitChoice& choice_;
    LightFit fit_;
    HeldLight fresh_;
    double wished_px_;
};

}  // namespace

void fit_views(const SceneSnapshot& scene, const FitInputs& inputs, FitStorage& storage, FittedViews& fitted,
               History& next_history, const LightAccounts& accounts) {
    const HeldLight none;
    fitted.views.clear();
    fitted.casters.clear();
    fitted.resized_sets.clear();
    fitted.resized_sets.camera_frusta = inputs.sets.camera_frusta;
    fitted.lights.assign(inputs.requests.size(), {});
    next_history.lights.clear();
    for (std::uint32_t i = 0; i < inputs.requests.size(); ++i) {
        LightStatus& status = accounts.statuses[i];
        FitChoice& choice = fitted.lights[i];
        choice.request = inputs.requests[i];
        choice.sets = inputs.sets.lights[i];
        if (choice.request.skip != Reason::none) continue;
        const LightTime time(accounts.cpu_us, i);
        const HeldLight* last = find(inputs.held, scene.lights[i].entity, next_history.lights.size());
        HeldLight& next = next_history.lights.emplace_back(last ? *last : none);
        next.light = scene.lights[i].entity;
        next.rays.gave_way = choice.request.rays.fell_back;
        if (!status.is_skipped()) {
            const HeldLight before = next;
            if (has_map(choice.request))
                status.skip(TargetFit(scene, inputs, i, before, storage, fitted).run(next));
            else if (choice.sets.casters.count == 0)
                status.skip(Reason::no_caster);
        }
        if (choice.request.note != Reason::none) status.degrade(choice.request.note);
    }
}

}  // namespace gnomon::shadow
