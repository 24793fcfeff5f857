#include "systems/shadow/fitting/fit_views.h"

#include <algorithm>

#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/frame/light_jobs.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/filter_choice.h"

namespace gnomon::shadow {
namespace {

/// Fit of one light with the filter that its targets need. The default filter is fitted first, because the choice
/// depends on that fit's accuracy. Lights without a target, or limited by a budget, keep their filter.
class TargetFit {
public:
    TargetFit(const SceneSnapshot& scene, const FitInputs& inputs, std::uint32_t light, const LightFitHistory& previous,
              StageScratch& scratch, FittedViews& out)
        : scene_(scene),
          inputs_(inputs),
          light_(scene.lights[light]),
          index_(light),
          previous_(previous),
          choice_(out.lights[light]),
          fit_(scene, inputs, light, scratch, out),
          targets_(targets_of(light_.shadow)) {}

    /// Fits the light. Returns why it has no views; Reason::none: it has some.
    Reason run(LightFitHistory& next) {
        next.filter = leaves_filter(light_) ? previous_.filter : FilterHistory{};
        const ShadowFilter filter = choice_.request.map.filter;
        if (!leaves_filter(light_) || (filter != kDefaultFilter && filter != kExactFilter)) return fit(previous_, next);
        return filter == kDefaultFilter ? run_usual(next) : run_exact(next);
    }

private:
    Reason fit(const LightFitHistory& previous, LightFitHistory& next, bool recount = false) {
        const FilterHistory chosen = next.filter;
        next = previous;
        const Reason reason = fit_.run(previous, recount, next);
        next.filter = chosen;
        return reason;
    }
    /// Fits without history, since that belongs to another filter's maps.
    Reason fit_anew(ShadowFilter filter, LightFitHistory& next) {
        const LightFitHistory fresh = without_fits(previous_);
        const DeviceMaps device{choice_.request.limits.device_px, choice_.request.map.references};
        fit_.request_anew(request_with(scene_, device, &fresh, index_, filter));
        return fit(fresh, next);
    }
    /// Returns the accuracy over all views that are looked up. One view may have the worst edges, and another the
    /// widest texels.
    MapAccuracy accuracy() const {
        MapAccuracy worst;
        for (const ShadowView& view : fit_.views()) {
            if (view.lit || !(view.error.edge_px > 0.0)) continue;
            const MapAccuracy own = accuracy_of(view);
            if (own.edge_px - own.grid_px > worst.edge_px - worst.grid_px || worst.edge_px == 0.0) {
                worst.edge_px = own.edge_px;
                worst.grid_px = own.grid_px;
            }
            worst.resolved_px = std::max(worst.resolved_px, own.resolved_px);
        }
        return worst;
    }
    /// Returns the largest error of edges by texels, pixels. While it stays, the visible scene is unchanged.
    double seen_px() const {
        double worst = 0.0;
        for (const ShadowView& view : fit_.views())
            if (!view.lit) worst = std::max(worst, view.error.texel_edge_px);
        return worst;
    }

    Reason run_usual(LightFitHistory& next) {
        const Reason reason = fit(previous_, next);
        if (reason != Reason::none || !(previous_.budget.grant == QualityLimits{})) return reason;
        ShadowFilter chosen = chosen_filter(previous_.filter, accuracy(), targets_);
        const bool turns = chosen == kExactFilter && previous_.filter.filter != kExactFilter;
        if (turns && choice_.request.limits.max_views > 0) {  // another number of cascades may meet the target
            const Reason recounted = fit(previous_, next, true);
            if (recounted != Reason::none) return recounted;
            chosen = chosen_filter(previous_.filter, accuracy(), targets_);
        }
        if (chosen == kDefaultFilter) {
            next.filter = {kDefaultFilter, targets_, {}};
            return Reason::none;
        }
        const MapAccuracy usual = accuracy();
        if (!turns || inputs_.budget_active) {  // the ray budget leaves it none, or may
            next.filter = {kExactFilter, targets_, usual};
            return Reason::none;
        }
        const Reason kept = fit_anew(kExactFilter, next);
        note_exact(usual, false, next);
        return kept;
    }

    Reason run_exact(LightFitHistory& next) {
        MapAccuracy usual = previous_.filter.usual;
        bool passed = false;
        if (is_trial_due(previous_.filter, targets_)) {
            const ShadowRequest own = choice_.request;
            const Reason reason = fit_anew(kDefaultFilter, next);
            if (reason == Reason::none) {
                usual = accuracy();
                passed = chosen_filter(previous_.filter, usual, targets_) == kDefaultFilter;
            }
            if (passed && comes_back(previous_.filter, targets_)) next.filter = {kDefaultFilter, targets_, {}};
            if (next.filter.filter == kDefaultFilter && !inputs_.budget_active) return reason;
            fit_.request_anew(own);
        }
        const Reason reason = fit(previous_, next);
        choice_.default_filter = usual;
        if (next.filter.filter == kExactFilter) note_exact(usual, passed, next);
        return reason;
    }

    void note_exact(const MapAccuracy& usual, bool passed, LightFitHistory& next) {
        next.filter = exact_history(previous_.filter, usual, passed, seen_px(), targets_);
        choice_.default_filter = usual;
    }

    const SceneSnapshot& scene_;
    const FitInputs& inputs_;
    const LightItem& light_;
    std::uint32_t index_;
    const LightFitHistory& previous_;
    FitChoice& choice_;
    LightFit fit_;
    AccuracyTargets targets_;
};

void clear(const ReceiverCasterSets& sets, FittedViews& fitted) {
    fitted.views.clear();
    fitted.casters.clear();
    fitted.caster_meshes.clear();
    fitted.resized_sets.clear();
    fitted.resized_sets.camera_frusta = sets.camera_frusta;
    fitted.resized_sets.nearest_surface_m = sets.nearest_surface_m;
}

/// Gives the arrays of `fitted` room for as much as those of `all`.
void reserve_as(const FittedViews& all, FittedViews& fitted) {
    fitted.views.reserve(all.views.capacity());
    fitted.casters.reserve(all.casters.capacity());
    fitted.caster_meshes.reserve(all.caster_meshes.capacity());
    reserve_as(all.resized_sets, fitted.resized_sets);
}

/// Appends one light's views, of `from`, to those of `to`.
void append_light(const FittedViews& from, std::uint32_t light, FittedViews& to) {
    FitChoice& choice = to.lights[light];
    choice = from.lights[light];
    if (choice.resized) choice.sets = append_sets(from.resized_sets, choice.sets, to.resized_sets);
    choice.views.first = static_cast<std::uint32_t>(to.views.size());
    for (const ShadowView& view : from.views_of(light)) {
        const auto casters = from.casters_of(view), meshes = from.meshes_of(view);
        ShadowView& there = to.views.emplace_back(view);
        there.casters.first = static_cast<std::uint32_t>(to.casters.size());
        to.casters.insert(to.casters.end(), casters.begin(), casters.end());
        if (meshes.empty()) continue;
        to.caster_meshes.resize(there.casters.first);
        to.caster_meshes.insert(to.caster_meshes.end(), meshes.begin(), meshes.end());
    }
}

/// Writes what each light begins with: its request and sets to `fitted`, its history to `next`. Lights that take no
/// part have no history; the others are listed in `taking`.
void begin_lights(const SceneSnapshot& scene, const FitInputs& inputs, FittedViews& fitted, History& next,
                  std::vector<std::uint32_t>& taking) {
    const LightFitHistory none;
    fitted.lights.assign(inputs.requests.size(), {});
    next.lights.clear();
    taking.clear();
    for (std::uint32_t i = 0; i < inputs.requests.size(); ++i) {
        FitChoice& choice = fitted.lights[i];
        choice.request = inputs.requests[i];
        choice.sets = inputs.sets.lights[i];
        if (choice.request.skip != Reason::none) continue;
        const LightFitHistory* last = find(inputs.previous, scene.lights[i].entity, next.lights.size());
        LightFitHistory& history = next.lights.emplace_back(last ? *last : none);
        history.light = scene.lights[i].entity;
        history.rays.fell_back = choice.request.rays.fell_back;
        taking.push_back(i);
    }
}

/// Calls `fit` for each light that takes part, on several threads, and puts their views in the order of the lights.
template <class Fit>
void fit_on_threads(const FitInputs& inputs, const Fit& fit, StageStorage& storage, FittedViews& fitted) {
    for (ThreadResults& results : storage.results) {
        clear(inputs.sets, results.fitted);
        results.fitted.lights.resize(fitted.lights.size());
    }
    for_each_light(inputs.jobs, storage.taking.size(), [&](std::size_t job, std::size_t thread) {
        const std::uint32_t light = storage.taking[job];
        FittedViews& out = storage.results[thread].fitted;
        storage.thread_of[light] = thread;
        out.lights[light] = fitted.lights[light];
        fit(job, thread, out);
    });
    for (const std::uint32_t light : storage.taking)
        append_light(storage.results[storage.thread_of[light]].fitted, light, fitted);
    for (ThreadResults& results : storage.results) reserve_as(fitted, results.fitted);  // any may fit most next time
}

}  // namespace

void fit_views(const SceneSnapshot& scene, const FitInputs& inputs, StageStorage& storage, FittedViews& fitted,
               History& next_history, const LightAccounts& accounts) {
    clear(inputs.sets, fitted);
    begin_lights(scene, inputs, fitted, next_history, storage.taking);
    const auto fit = [&](std::size_t job, std::size_t thread, FittedViews& out) {
        const std::uint32_t i = storage.taking[job];
        const LightTimer time(accounts.cpu_us, i);
        LightStatus& status = accounts.statuses[i];
        LightFitHistory& next = next_history.lights[job];
        FitChoice& choice = out.lights[i];
        if (!status.is_skipped()) {
            const LightFitHistory before = next;
            if (has_map(choice.request))
                status.skip(TargetFit(scene, inputs, i, before, storage.scratch[thread], out).run(next));
            else if (choice.sets.casters.count == 0)
                status.skip(Reason::no_caster);
        }
        if (choice.request.note != Reason::none) status.degrade(choice.request.note);
    };
    const std::size_t threads = threads_for(inputs.jobs, storage.taking.size());
    provide_threads(threads, fitted.lights.size(), storage);
    if (threads > 1) return fit_on_threads(inputs, fit, storage, fitted);
    for (std::size_t job = 0; job < storage.taking.size(); ++job) fit(job, 0, fitted);
}

}  // namespace gnomon::shadow
