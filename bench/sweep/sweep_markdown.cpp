#include <algorithm>

#include "bench/sweep/sweep_json.h"
#include "bench/sweep/sweep_report.h"
#include "bench/text/format_number.h"

namespace gnomon::bench {
namespace {

constexpr double kBytesPerMb = 1.0e6, kUsPerMs = 1000.0;

std::string halvings(const SceneSweep& sweep, const std::string& light, SweepTruth truth) {
    const HalvingCost found = halving_cost(sweep, light, truth, SweepCost::drawn);
    if (found.steps.empty()) return "";
    std::string text = "| " + light + (truth == SweepTruth::point ? "" : ", soft") +
                       " | error | time, × defaults | × time for half the error |\n|---|---|---|---|\n";
    const auto line = [&](const Choice& choice, const std::string& factor) {
        text += "| `" + sweep.plan[choice.row].name + "` | " + percent_words(choice.error) + " | " +
                factor_words(choice.cost) + " | " + factor + " |\n";
    };
    line(found.steps.front().from, "");
    for (const Halving& step : found.steps) line(step.to, factor_words(step.cost_factor()));
    return text + "\n";
}

std::string figure(const Figure& value, double scale, const char* unit = "") {
    return value ? factor_words(*value * scale) + unit : std::string("-");
}

/// The defaults and the tutorials' rows, side by side.
std::string landmarks(const SceneSweep& sweep) {
    std::string text =
        "| row | light | wrong % | acne % | leak % | edge p99 px | predicted px | MB | draws | ms | × defaults | kept, "
        "ms "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    constexpr double kPercent = 100.0;
    for (std::size_t row = 0; row < sweep.plan.size(); ++row) {
        if (sweep.plan[row].factor != kDefaultsRow && sweep.plan[row].factor != kTutorialFactor) continue;
        for (const LightRow& light : sweep.rows[row].lights) {
            const RowFigures& f = light.figures;
            const auto median = [](const Spread& s, double scale) {
                return s.count > 0 ? factor_words(s.median * scale) : std::string("-");
            };
            text += "| " + sweep.plan[row].name + " | " + light.light;
            for (const std::string& cell :
                 {figure(f.wrong, kPercent), figure(f.acne, kPercent), figure(f.leak, kPercent),
                  figure(f.edge_p99_px, 1.0), figure(f.predicted_px, 1.0), figure(f.bytes, 1.0 / kBytesPerMb),
                  figure(f.draws, 1.0), median(f.gpu_us, 1.0 / kUsPerMs), median(f.gpu_ratio, 1.0),
                  median(f.kept_us, 1.0 / kUsPerMs)})
                text += " | " + cell;
            text += " |\n";
        }
    }
    return text + "\n";
}

/// Every front, cheapest first.
std::string fronts(const SceneSweep& sweep, const std::string& light) {
    std::string text;
    for (const SweepTruth truth : kSweepTruths)
        for (const SweepCost cost : kSweepCosts) {
            std::string names;
            for (const Choice& choice : choices(sweep, light, truth, cost))
                if (choice.best)
                    names +=
                        (names.empty() ? "" : "; ") + ("`" + sweep.plan[choice.row].name + "` " +
                                                       percent_words(choice.error) + " × " + factor_words(choice.cost));
            if (!names.empty())
                text += "- " + light + ", " + to_text(truth) + ", maps " + to_text(cost) + ": " + names + "\n";
        }
    return text;
}

/// Places that are farther off than predicted, over all rows of a light.
std::string bounds(const SceneSweep& sweep) {
    std::string text =
        "| light | rows | places | farther off than predicted: sub_texel_caster | truth_ambiguous | other_bias | "
        "unexplained | rows with unexplained ones |\n|---|---|---|---|---|---|---|---|\n";
    for (const std::string& name : lights_of(sweep)) {
        double rows = 0.0, places = 0.0, sub_texel = 0.0, ambiguous = 0.0, bias = 0.0, unexplained = 0.0;
        std::string which;
        for (std::size_t row = 0; row < sweep.plan.size(); ++row) {
            const LightRow* light = find_row(sweep, row, name);
            if (!light || !light->figures.unexplained) continue;
            const RowFigures& f = light->figures;
            rows += 1.0;
            places += f.edge_places.value_or(0.0);
            sub_texel += f.sub_texel_caster.value_or(0.0);
            ambiguous += f.truth_ambiguous.value_or(0.0);
            bias += f.other_bias.value_or(0.0);
            unexplained += *f.unexplained;
            if (*f.unexplained > 0.0) which += (which.empty() ? "`" : ", `") + sweep.plan[row].name + "`";
        }
        text += "| " + name;
        for (const double count : {rows, places, sub_texel, ambiguous, bias, unexplained})
            text += " | " + std::to_string(static_cast<std::uint64_t>(count));
        text += " | " + (which.empty() ? std::string("none") : which) + " |\n";
    }
    return text + "\n";
}

}  // namespace

std::string sweep_markdown(const std::vector<SceneSweep>& scenes) {
    std::string text;
    for (const SceneSweep& sweep : scenes) {
        text += "## " + sweep.scene + "\n\nDevice: " + sweep.device + ". Picture: " + std::to_string(sweep.size_px.x) +
                " × " + std::to_string(sweep.size_px.y) + ". Rows: " + std::to_string(sweep.plan.size()) +
                ", rounds of times: " + std::to_string(sweep.rounds) + ".\n\n### What halving the error costs\n\n";
        for (const std::string& sentence : halving_sentences(sweep)) text += sentence + "\n\n";
        for (const std::string& light : lights_of(sweep))
            for (const SweepTruth truth : kSweepTruths) text += halvings(sweep, light, truth);
        text += "### The defaults beside what tutorials set up\n\n" + landmarks(sweep);
        text += "### Rows that are best at some cost\n\n";
        for (const std::string& light : lights_of(sweep)) text += fronts(sweep, light);
        text += "\nNever best, for any light, truth or time: ";
        const std::vector<std::string> never = never_best(sweep);
        for (std::size_t i = 0; i < never.size(); ++i) text += (i == 0 ? "`" : ", `") + never[i] + "`";
        text += (never.empty() ? "none" : "") + std::string(".\n\n### The bound\n\n") + bounds(sweep);
    }
    return text;
}

}  // namespace gnomon::bench
