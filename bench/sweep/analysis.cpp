#include "bench/sweep/analysis.h"

#include <algorithm>
#include <cmath>

#include "bench/compare/pareto_front.h"

namespace gnomon::bench {
namespace {

Figure error_of(const RowFigures& figures, SweepTruth truth) {
    if (truth == SweepTruth::disk) return figures.disk_error;
    if (!figures.wrong || !figures.scored_px) return std::nullopt;
    const double half_pixel = 0.5 / std::max(*figures.scored_px, 1.0);
    return std::max(*figures.wrong, half_pixel);
}

Figure cost_of(const RowFigures& figures, SweepCost cost) {
    const Spread& ratio = cost == SweepCost::drawn ? figures.gpu_ratio : figures.kept_ratio;
    return ratio.count > 0 && ratio.median > 0.0 ? Figure(ratio.median) : std::nullopt;
}

const Choice* find(const std::vector<Choice>& all, std::size_t row) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Choice& c) { return c.row == row; });
    return found == all.end() ? nullptr : &*found;
}

/// The cheapest of the front with at most so much error; `all` is sorted by cost.
const Choice* cheapest(const std::vector<Choice>& all, double most_error) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Choice& c) { return c.best && c.error <= most_error; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace

const char* to_text(SweepTruth truth) { return truth == SweepTruth::point ? "point" : "disk"; }
const char* to_text(SweepCost cost) { return cost == SweepCost::drawn ? "drawn" : "kept"; }

const LightRow* find_row(const SceneSweep& sweep, std::size_t row, const std::string& light) {
    for (const LightRow& found : sweep.rows[row].lights)
        if (found.light == light) return &found;
    return nullptr;
}

std::vector<std::string> lights_of(const SceneSweep& sweep) {
    std::vector<std::string> names;
    for (const JudgedRow& row : sweep.rows)
        for (const LightRow& light : row.lights)
            if (std::find(names.begin(), names.end(), light.light) == names.end()) names.push_back(light.light);
    return names;
}

std::vector<Choice> choices(const SceneSweep& sweep, const std::string& light, SweepTruth truth, SweepCost cost) {
    std::vector<Choice> all;
    for (std::size_t row = 0; row < sweep.plan.size(); ++row) {
        const LightRow* found = find_row(sweep, row, light);
        if (!found) continue;
        const Figure error = error_of(found->figures, truth);
        Figure time = cost_of(found->figures, cost);
        // All others are measured against them, so what their own row shows is noise.
        if (time && sweep.plan[row].name == kDefaultsRow) time = 1.0;
        if (error && time) all.push_back({row, *error, *time, false});
    }
    std::stable_sort(all.begin(), all.end(), [](const Choice& a, const Choice& b) { return a.cost < b.cost; });
    std::vector<ErrorAndCost> figures;
    for (const Choice& choice : all) figures.push_back({choice.error, choice.cost});
    const std::vector<std::uint8_t> best = on_front(figures);
    for (std::size_t i = 0; i < all.size(); ++i) all[i].best = best[i] != 0;
    return all;
}

double Halving::error_factor() const { return from.error > 0.0 ? to.error / from.error : 1.0; }

HalvingCost halving_cost(const SceneSweep& sweep, const std::string& light, SweepTruth truth, SweepCost cost) {
    HalvingCost found;
    const std::vector<Choice> all = choices(sweep, light, truth, cost);
    const Choice* at = cheapest(all, INFINITY);
    const Choice* first = at;
    while (at && at->error > 0.0) {
        const Choice* next = cheapest(all, 0.5 * at->error);
        if (!next) break;
        found.steps.push_back({*at, *next});
        at = next;
    }
    if (at != first) {
        const double halvings = std::log2(first->error / std::max(at->error, first->error * 1.0e-9));
        found.factor = std::pow(at->cost / first->cost, 1.0 / halvings);
    }
    for (std::size_t row = 0; row < sweep.plan.size(); ++row)
        if (sweep.plan[row].name == kDefaultsRow)
            if (const Choice* defaults = find(all, row)) {
                found.defaults = *defaults;
                if (const Choice* half = cheapest(all, 0.5 * defaults->error))
                    found.from_defaults = Halving{*defaults, *half};
            }
    return found;
}

std::optional<Missed> missed_by_defaults(const SceneSweep& sweep, const std::string& light, SweepCost cost) {
    const std::vector<Choice> all = choices(sweep, light, SweepTruth::point, cost);
    const auto defaults =
        std::find_if(all.begin(), all.end(), [&](const Choice& c) { return sweep.plan[c.row].name == kDefaultsRow; });
    if (defaults == all.end()) return std::nullopt;
    const auto errors_of = [&](const Choice& choice) {
        const RowFigures& figures = find_row(sweep, choice.row, light)->figures;
        return PromisedErrors{choice.error, figures.leak.value_or(0.0), figures.acne.value_or(0.0),
                              figures.false_shadow_far, figures.false_light_far};
    };
    const auto keeps_all = [&](const Choice& choice) { return keeps_promise(errors_of(choice)); };
    if (keeps_all(*defaults)) return std::nullopt;
    Missed missed;
    missed.errors = errors_of(*defaults);
    const RowFigures& figures = find_row(sweep, defaults->row, light)->figures;
    missed.sub_texel = figures.sub_texel_caster.value_or(0.0);
    for (const Figure& count : {figures.sub_texel_caster, figures.truth_ambiguous, figures.unexplained})
        missed.beyond += count.value_or(0.0);
    // They are sorted by cost.
    const auto reached = std::find_if(all.begin(), all.end(), keeps_all);
    if (reached != all.end()) missed.reached = *reached;
    return missed;
}

std::optional<BesideTutorial> beside_tutorial(const SceneSweep& sweep, const std::string& light) {
    const Choice *defaults = nullptr, *tutorial = nullptr;
    const std::vector<Choice> all = choices(sweep, light, SweepTruth::point, SweepCost::drawn);
    for (const Choice& choice : all) {
        if (sweep.plan[choice.row].name == kDefaultsRow) defaults = &choice;
        const bool is_tutorial = sweep.plan[choice.row].factor == kTutorialFactor;
        if (is_tutorial && (!tutorial || choice.row < tutorial->row)) tutorial = &choice;
    }
    if (!defaults || !tutorial) return std::nullopt;
    BesideTutorial found{*tutorial, defaults->cost / tutorial->cost, {}};
    const Spread& kept_us = find_row(sweep, defaults->row, light)->figures.kept_us;
    const Spread& tutorial_us = find_row(sweep, tutorial->row, light)->figures.gpu_us;
    if (kept_us.count > 0 && tutorial_us.count > 0) found.kept = kept_us.median / tutorial_us.median;
    return found;
}

std::vector<Bargain> bargains(const SceneSweep& sweep, const std::string& light, SweepCost cost) {
    std::vector<Bargain> found;
    const std::vector<Choice> all = choices(sweep, light, SweepTruth::point, cost);
    for (const Choice& tutorial : all) {
        if (sweep.plan[tutorial.row].factor != kTutorialFactor) continue;
        const Choice* best = nullptr;
        for (const Choice& other : all)
            if (other.cost <= tutorial.cost * (1.0 + kCostNoise) && (!best || other.error < best->error)) best = &other;
        if (best) found.push_back({tutorial, *best});
    }
    return found;
}

std::vector<std::string> never_best(const SceneSweep& sweep) {
    std::vector<bool> best(sweep.plan.size(), false), judged(sweep.plan.size(), false);
    for (const std::string& light : lights_of(sweep))
        for (const SweepTruth truth : kSweepTruths)
            for (const SweepCost cost : kSweepCosts)
                for (const Choice& choice : choices(sweep, light, truth, cost)) {
                    judged[choice.row] = true;
                    if (choice.best) best[choice.row] = true;
                }
    std::vector<std::string> names;
    for (std::size_t row = 0; row < best.size(); ++row)
        if (judged[row] && !best[row]) names.push_back(sweep.plan[row].name);
    return names;
}

}  // namespace gnomon::bench
