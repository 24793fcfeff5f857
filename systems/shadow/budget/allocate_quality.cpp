#include "systems/shadow/budget/allocate_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "systems/shadow/request/limited_request.h"

namespace gnomon::shadow {
namespace {

constexpr std::uint32_t kMostRefresh_frames = 4;  // a fifteenth of a second: slower updates are seen to jump

/// Limits one step away from those of a light, one item per kind of step. Impossible steps are left out.
struct NextGrants {
    std::array<QualityLimits, 5> items;
    std::size_t count = 0;
    void add(const QualityLimits& grant) { items[count++] = grant; }
    const QualityLimits* begin() const { return items.data(); }
    const QualityLimits* end() const { return items.data() + count; }
};

NextGrants next_grants(const LightLoad& load, const QualityLimits& now) {
    NextGrants next;
    if (now.none) return next;
    const ShadowRequest& wanted = load.wanted;
    const std::uint32_t edge_px = std::min(wanted.map.resolution_px, now.most_px);
    const auto add_less = [&](const QualityLimits& less) {
        if (!(less == now) && is_less(*load.light, wanted, less)) next.add(less);
    };
    QualityLimits less = now;
    less.most_px = std::max(edge_px / 2, kLeastGranted_px);
    if (less.most_px < edge_px) add_less(less);
    less = now;
    less.most_views = std::min(now.most_views, wanted.map.view_count) - 1;
    const ShadowRequest fewer = granted(*load.light, wanted, less);
    if (less.most_views > 0 && fewer.map.view_count == less.most_views) add_less(less);
    less = now;
    less.plain = true;
    if (wanted.map.filter != kCheapestFilter) add_less(less);
    less = now;
    less.refresh_frames = std::max(now.refresh_frames, 1u) * 2;
    if (less.refresh_frames <= kMostRefresh_frames && load.activity > 0.0) add_less(less);
    less = {};
    less.none = true;
    add_less(less);
    return next;
}

/// Returns limits one step back toward `start`. `lastly`: the first step for a light that has no map.
NextGrants more_grants(const QualityLimits& now, const QualityLimits& start, const QualityLimits& lastly) {
    NextGrants next;
    const auto add_more = [&](const QualityLimits& more) {
        if (!(more == now)) next.add(more);
    };
    if (now.none) {
        if (!start.none) next.add(lastly);
        return next;
    }
    QualityLimits more = now;
    more.most_px = now.most_px <= start.most_px / 2 ? std::min(2 * now.most_px, start.most_px) : start.most_px;
    add_more(more);
    more = now;
    more.most_views = std::min(now.most_views, start.most_views - 1) + 1;
    add_more(more);
    more = now;
    more.plain = start.plain;
    add_more(more);
    more = now;
    more.refresh_frames = std::max(now.refresh_frames / 2, start.refresh_frames);
    add_more(more);
    return next;
}

double share(std::uint64_t a, std::uint64_t b) {
    return static_cast<double>(a) / static_cast<double>(std::max<std::uint64_t>(b, 1));
}
/// Least share of a budget that a step counts as freeing, so that its price stays finite.
constexpr double kLeastShare = 1.0e-12;

std::uint64_t less_by(std::uint64_t before, std::uint64_t after) { return before > after ? before - after : 0; }

/// Price added to steps that take more than texels of a light with LightLoad::sizes_first: above that of any other.
constexpr double kLaterPrice = 1.0 / kLeastShare;

class Taking {
public:
    Taking(std::span<const LightLoad> loads, const BudgetLimits& limits, const CostFactors& factors,
           std::span<QualityLimits> grants, BudgetScratch& scratch)
        : loads_(loads), limits_(limits), factors_(factors), grants_(grants), scratch_(scratch) {}

    BudgetUse run() {
        scratch_.costs.clear();
        scratch_.start.assign(grants_.begin(), grants_.end());
        scratch_.lastly.assign(grants_.begin(), grants_.end());
        for (std::size_t i = 0; i < loads_.size(); ++i) {
            scratch_.costs.push_back(cost_of(loads_[i], grants_[i], factors_));
            add(scratch_.costs.back());
        }
        while (!holds(limits_, use_))
            if (!take()) break;
        give_back();
        use_.harm = 0.0;
        for (const Cost& cost : scratch_.costs) use_.harm += cost.harm;
        return use_;
    }

private:
    using Step = BudgetScratch::Step;

    void add(const Cost& cost) {
        use_.bytes += cost.bytes;
        use_.ns += cost.ns;
    }
    void replace(std::uint32_t load, const QualityLimits& grant, const Cost& cost) {
        use_.bytes -= scratch_.costs[load].bytes;
        use_.ns -= scratch_.costs[load].ns;
        add(cost);
        scratch_.costs[load] = cost;
        grants_[load] = grant;
    }
    /// Orders a heap so that its top has the lowest price. The light's key decides between equal prices. Lights with
    /// equal keys look the same.
    bool comes_after(const Step& a, const Step& b) const {
        if (a.price != b.price) return a.price > b.price;
        const std::uint64_t key_a = loads_[a.load].key, key_b = loads_[b.load].key;
        return key_a != key_b ? key_a > key_b : a.load > b.load;
    }
    auto later() const {
        return [this](const Step& a, const Step& b) { return comes_after(a, b); };
    }
    void push(const Step& step) {
        scratch_.steps.push_back(step);
        std::push_heap(scratch_.steps.begin(), scratch_.steps.end(), later());
    }
    Step pop() {
        std::pop_heap(scratch_.steps.begin(), scratch_.steps.end(), later());
        const Step step = scratch_.steps.back();
        scratch_.steps.pop_back();
        return step;
    }
    double share_of(std::uint64_t bytes, std::uint64_t ns) const {
        return (counts_bytes_ ? share(bytes, limits_.bytes) : 0.0) + (counts_ns_ ? share(ns, limits_.ns) : 0.0);
    }
    bool fits(std::uint32_t load, const Cost& cost) const {
        const Cost& now = scratch_.costs[load];
        return holds(limits_, {use_.bytes - now.bytes + cost.bytes, use_.ns - now.ns + cost.ns, 0.0});
    }

    /// Pushes the light's cheapest step to less quality, if there is one.
    void push_less(std::uint32_t load) {
        const Cost& now = scratch_.costs[load];
        const NextGrants next = next_grants(loads_[load], grants_[load]);
        Step best{std::numeric_limits<double>::infinity(), load, {}, {}};
        bool found = false;
        for (const QualityLimits& less : next) {
            const Cost cost = cost_of(loads_[load], less, factors_);
            const double freed = share_of(less_by(now.bytes, cost.bytes), less_by(now.ns, cost.ns));
            const bool shrinks = less.most_px < grants_[load].most_px || less.most_views < grants_[load].most_views;
            const double last_resort = loads_[load].sizes_first && !shrinks ? kLaterPrice : 0.0;
            const double price = last_resort + std::max(cost.harm - now.harm, 0.0) / freed;
            if (!(freed > 0.0) || (found && !(price < best.price))) continue;
            best = {price, load, less, cost};
            found = true;
        }
        if (found) push(best);
    }
    /// Takes quality away until one of the exceeded budgets is met. Prices count only the budgets that are exceeded.
    bool take() {
        counts_bytes_ = use_.bytes > limits_.bytes;
        counts_ns_ = use_.ns > limits_.ns;
        scratch_.steps.clear();
        for (std::uint32_t i = 0; i < loads_.size(); ++i) push_less(i);
        bool any = false;
        while (!scratch_.steps.empty() && counts_bytes_ == (use_.bytes > limits_.bytes) &&
               counts_ns_ == (use_.ns > limits_.ns)) {
            const Step step = pop();
            if (step.grant.none) scratch_.lastly[step.load] = grants_[step.load];
            replace(step.load, step.grant, step.cost);
            push_less(step.load);
            any = true;
        }
        return any;
    }
    /// Pushes the light's best step to more quality that fits, if there is one.
    void push_more(std::uint32_t load) {
        const Cost& now = scratch_.costs[load];
        const NextGrants next = more_grants(grants_[load], scratch_.start[load], scratch_.lastly[load]);
        Step best{0.0, load, {}, {}};
        for (const QualityLimits& more : next) {
            const Cost cost = cost_of(loads_[load], more, factors_);
            const double gain = now.harm - cost.harm;
            if (!(gain > 0.0) || !fits(load, cost)) continue;
            const double taken = share_of(less_by(cost.bytes, now.bytes), less_by(cost.ns, now.ns));
            const double price = -gain / std::max(taken, kLeastShare);
            if (price < best.price) best = {price, load, more, cost};
        }
        if (best.price < 0.0) push(best);
    }
    void give_back() {
        counts_bytes_ = limits_.bytes != BudgetLimits::kNone;
        counts_ns_ = limits_.ns != BudgetLimits::kNone;
        scratch_.steps.clear();
        for (std::uint32_t i = 0; i < loads_.size(); ++i)
            if (!(grants_[i] == scratch_.start[i])) push_more(i);
        while (!scratch_.steps.empty()) {
            const Step step = pop();
            // Other lights may have taken the room; a smaller step may still fit.
            if (fits(step.load, step.cost)) replace(step.load, step.grant, step.cost);
            push_more(step.load);
        }
    }

    std::span<const LightLoad> loads_;
    BudgetLimits limits_;
    CostFactors factors_;
    std::span<QualityLimits> grants_;
    BudgetScratch& scratch_;
    BudgetUse use_;
    bool counts_bytes_ = false, counts_ns_ = false;  // prices count bytes; prices count time
};

std::uint64_t with_room(std::uint64_t limit) {
    return limit == BudgetLimits::kNone ? limit : static_cast<std::uint64_t>(kRoomAfter * static_cast<double>(limit));
}

}  // namespace

BudgetLimits limits_of(const ShadowBudget& budget) {
    static_assert(ShadowBudget::kUnlimited == BudgetLimits::kNone);
    BudgetLimits limits;
    if (budget.bytes > 0) limits.bytes = budget.bytes;  // ShadowBudget::kUnlimited is kNone
    const double ns = static_cast<double>(budget.gpu_ms) * 1.0e6;
    if (ns > 0.0 && ns < 1.0e18) limits.ns = std::max<std::uint64_t>(static_cast<std::uint64_t>(ns), 1);
    return limits;
}

BudgetUse use_of(std::span<const LightLoad> loads, std::span<const QualityLimits> grants, const CostFactors& factors) {
    BudgetUse use;
    for (std::size_t i = 0; i < loads.size(); ++i) {
        const Cost cost = cost_of(loads[i], grants[i], factors);
        use.bytes += cost.bytes;
        use.ns += cost.ns;
        use.harm += cost.harm;
    }
    return use;
}

BudgetUse take_away(std::span<const LightLoad> loads, const BudgetLimits& limits, const CostFactors& factors,
                    std::span<QualityLimits> grants, BudgetScratch& scratch) {
    return Taking(loads, limits, factors, grants, scratch).run();
}

BudgetUse settle_limits(std::span<const LightLoad> loads, const BudgetLimits& limits, const CostFactors& factors,
                        std::uint32_t& frames_since_grants, std::span<QualityLimits> grants, BudgetScratch& scratch) {
    const BudgetUse use = use_of(loads, grants, factors);
    if (!holds(limits, use)) {
        frames_since_grants = 0;
        return take_away(loads, limits, factors, grants, scratch);
    }
    frames_since_grants = std::min(frames_since_grants + 1, kFramesToRegrant);
    if (frames_since_grants < kFramesToRegrant) return use;
    bool any = false;
    for (std::size_t i = 0; i < loads.size() && !any; ++i) any = is_less(*loads[i].light, loads[i].wanted, grants[i]);
    if (!any) return use;
    scratch.fresh.assign(loads.size(), QualityLimits{});
    const BudgetUse fresh_use =
        take_away(loads, {with_room(limits.bytes), with_room(limits.ns)}, factors, scratch.fresh, scratch);
    double gain = 0.0, loss = 0.0;
    for (std::size_t i = 0; i < loads.size(); ++i) {
        const double change = cost_of(loads[i], grants[i], factors).harm - scratch.costs[i].harm;
        (change > 0.0 ? gain : loss) += std::abs(change);
    }
    if (!(gain > kLeastGain * loss)) return use;
    std::copy(scratch.fresh.begin(), scratch.fresh.end(), grants.begin());
    frames_since_grants = 0;
    return fresh_use;
}

}  // namespace gnomon::shadow
