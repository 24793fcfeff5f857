#include <algorithm>

#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/fitting/fit_light.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/request/accuracy_target.h"
#include "systems/shadow/request/decide_requests.h"
#include "systems/shadow/request/filter_choice.h"

namespace gnomon::shadow {
namespace {

/// One light's fit by the filter that its contract chooses: by what the usual filter's maps turn out to err by, and
/// therefore after they are fitted. Others, and those of whom a budget took, are fitted for the demand that they have.
class ContractFit {
public:
    ContractFit(const SceneSnapshot& scene, std::uint32_t d, const HeldLight& held, HeldLight& next, ShadowFrame& frame)
        : scene_(scene),
          light_(scene.lights[frame.demands[d].light]),
          d_(d),
          held_(held),
          next_(next),
          frame_(frame),
          first_view_(frame.views.size()),
          first_caster_(frame.view_caster_items.size()),
          fresh_(without_fits(held)),
          wished_px_(wished_error_px(light_.shadow)) {}

    void run() {
        next_.filter = leaves_filter(light_) ? held_.filter : HeldFilter{};
        const ShadowFilter filter = demand().filter;
        if (!leaves_filter(light_) || (filter != kUsualFilter && filter != kKeepingFilter))
            fit(held_);
        else if (filter == kUsualFilter)
            run_usual();
        else
            run_keeping();
    }

private:
    ShadowDemand& demand() { return frame_.demands[d_]; }
    Reason& skip() { return frame_.sets[d_].skip; }

    void fit(const HeldLight& held, bool recount = false) {
        const HeldFilter chosen = next_.filter;
        frame_.views.resize(first_view_);
        frame_.view_caster_items.resize(first_caster_);
        next_ = held;
        fit_light_views(scene_, d_, held, recount, next_, frame_);
        next_.filter = chosen;
    }
    /// As if it were the first fit of this light: what is held is of another filter's maps.
    void fit_anew(const ShadowDemand& wish) {
        demand() = wish;
        select_sets_again(scene_, d_, frame_);
        fit(fresh_);
    }
    ShadowDemand demand_by(ShadowFilter filter) const {
        return demand_with(scene_, frame_.demands[d_].device_px, &fresh_, frame_.demands[d_].light, filter);
    }
    /// Of all views that are looked up, as the report has it.
    double worst_px() const {
        double worst = 0.0;
        for (std::size_t v = first_view_; v < frame_.views.size(); ++v)
            if (!frame_.views[v].lit) worst = std::max(worst, frame_.views[v].predicted_error_px);
        return worst;
    }

    void run_usual() {
        fit(held_);
        if (skip() != Reason::none || !(held_.grant == Grant{})) return;
        ShadowFilter chosen = chosen_filter(held_.filter, worst_px(), wished_px_);
        const bool turns = chosen == kKeepingFilter && held_.filter.filter != kKeepingFilter;
        if (turns && demand().most_views > 0) {  // another number of cascades may do
            fit(held_, true);
            chosen = chosen_filter(held_.filter, worst_px(), wished_px_);
        }
        if (chosen == kUsualFilter) {
            next_.filter = {kUsualFilter, wished_px_};
            return;
        }
        const double usual_px = worst_px();
        if (!turns || frame_.shared_out) {  // others' rays leave it none, or may
            next_.filter = {kKeepingFilter, wished_px_, usual_px};
            return;
        }
        fit_anew(demand_by(kKeepingFilter));
        keep(usual_px, false);
    }

    void run_keeping() {
        double usual_px = held_.filter.usual_px;
        bool passed = false;
        if (is_trial_due(held_.filter, wished_px_)) {
            const ShadowDemand own = demand();
            fit_anew(demand_by(kUsualFilter));
            if (skip() == Reason::none) {
                usual_px = worst_px();
                passed = chosen_filter(held_.filter, usual_px, wished_px_) == kUsualFilter;
            }
            if (passed && comes_back(held_.filter, wished_px_)) next_.filter = {kUsualFilter, wished_px_};
            if (next_.filter.filter == kUsualFilter && !frame_.shared_out) return;
            skip() = Reason::none;
            demand() = own;
            select_sets_again(scene_, d_, frame_);
        }
        fit(held_);
        demand().usual_px = usual_px;
        if (next_.filter.filter == kKeepingFilter) keep(usual_px, passed);
    }

    void keep(double usual_px, bool passed) {
        next_.filter = held_keeping(held_.filter, usual_px, passed, worst_px(), wished_px_);
        demand().usual_px = usual_px;
    }

    const SceneSnapshot& scene_;
    const LightItem& light_;
    std::uint32_t d_;
    const HeldLight& held_;
    HeldLight& next_;
    ShadowFrame& frame_;
    std::size_t first_view_, first_caster_;
    HeldLight fresh_;
    double wished_px_;
};

}  // namespace

void fit_views(const SceneSnapshot& scene, const History& held, ShadowFrame& frame) {
    const HeldLight none;
    frame.views.clear();
    frame.next_history.lights.clear();
    frame.view_caster_items.clear();
    for (std::uint32_t d = 0; d < frame.demands.size(); ++d) {
        PotentialSets& sets = frame.sets[d];
        const ShadowDemand& demand = frame.demands[d];
        if (demand.skip != Reason::none) continue;
        const LightTime time(frame, demand.light);
        const LightItem& light = scene.lights[demand.light];
        const HeldLight* last = find(held, light.entity, frame.next_history.lights.size());
        HeldLight& next = frame.next_history.lights.emplace_back(last ? *last : none);
        next.light = light.entity;
        next.gave_way = demand.gives_way;
        if (sets.skip != Reason::none) continue;
        if (!has_map(demand)) {
            if (sets.casters.count == 0) sets.skip = Reason::no_caster;
            continue;
        }
        const HeldLight before = next;
        ContractFit(scene, d, before, next, frame).run();
    }
}

}  // namespace gnomon::shadow
