#include <algorithm>
#include <array>
#include <cmath>

#include "bench/sweep/sweep_report.h"
#include "bench/text/format_number.h"
#include "bench/text/svg.h"

namespace gnomon::bench {
namespace {

constexpr double kLeft = 64.0, kTop = 48.0, kWide = 470.0, kHigh = 300.0, kRight = 16.0, kBottom = 46.0;
constexpr double kDot = 3.0, kLargeDot = 5.5, kLabelGap = 8.0;
constexpr double kMargin = 1.15;  // around what is shown, as a factor

/// Factors by what they vary, so that colours tell them apart.
struct Hue {
    std::string_view factor;
    const char* colour;
};
constexpr Hue kHues[] = {{kDefaultsRow, "#000000"}, {kTutorialFactor, "#c0392b"}, {"filter", "#1f6fb2"},
                         {"resolution", "#2e8b57"}, {"bias", "#b8860b"},          {"cascades", "#8e44ad"},
                         {"fit", "#d2691e"},        {"format", "#008b8b"}};

/// That of what is crossed with the resolution, else of the factor itself.
const char* colour_of(const std::string& factor) {
    const std::string varied =
        factor.starts_with("resolution x ") ? factor.substr(std::string("resolution x ").size()) : factor;
    for (const Hue& hue : kHues)
        if (hue.factor == varied) return hue.colour;
    return "#555555";
}

struct LogScale {
    double low = 1.0, high = 10.0;
    explicit LogScale(std::vector<double> values) {
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        low = *least / kMargin;
        high = *most * kMargin;
    }
    double share(double value) const { return std::log(value / low) / std::log(high / low); }
    /// 1, 2 and 5 of each decade that is shown.
    std::vector<double> ticks() const {
        std::vector<double> found;
        for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade <= high; decade *= 10.0)
            for (const double step : {1.0, 2.0, 5.0})
                if (decade * step >= low && decade * step <= high) found.push_back(decade * step);
        return found;
    }
};

struct Panel {
    LogScale x, y;
    glm::dvec2 at(const Choice& c) const { return at(c.cost, c.error); }
    glm::dvec2 at(double cost, double error) const {
        return {kLeft + kWide * x.share(cost), kTop + kHigh * (1.0 - y.share(error))};
    }
};

void draw_axes(Svg& svg, const Panel& panel, SweepTruth truth, SweepCost cost) {
    constexpr const char* kGrid = "stroke='#e4e4e4'";
    constexpr double kPercent = 100.0, kBelow = 16.0;
    for (const double tick : panel.x.ticks()) {
        const double x = panel.at(tick, panel.y.low).x;
        svg.line({x, kTop}, {x, kTop + kHigh}, kGrid);
        svg.text({x, kTop + kHigh + kBelow}, short_number(tick), "text-anchor='middle'");
    }
    for (const double tick : panel.y.ticks()) {
        const double y = panel.at(panel.x.low, tick).y;
        svg.line({kLeft, y}, {kLeft + kWide, y}, kGrid);
        svg.text({kLeft - kLabelGap, y + 4.0}, short_number(kPercent * tick), "text-anchor='end'");
    }
    svg.rectangle({kLeft, kTop}, {kLeft + kWide, kTop + kHigh}, "fill='none' stroke='#888'");
    svg.text({kLeft + 0.5 * kWide, kTop + kHigh + 2.0 * kBelow + 6.0},
             std::string("time of depth and lighting pass, as a multiple of the defaults', ") +
                 (cost == SweepCost::drawn ? "every view drawn" : "maps kept"),
             "text-anchor='middle'");
    svg.text({0.0, 0.0}, truth == SweepTruth::point ? "wrong pixels, %" : "mean error, %",
             "text-anchor='middle' transform='translate(14 " + short_number(kTop + 0.5 * kHigh) + ") rotate(-90)'");
}

/// On the side where there is room.
void draw_label(Svg& svg, const glm::dvec2& at, const std::string& words, const std::string& colour) {
    const bool right = at.x > kLeft + 0.6 * kWide;
    svg.text(at + glm::dvec2(right ? -kLabelGap : kLabelGap, -kLabelGap), words,
             "font-size='10' fill='" + colour + "' text-anchor='" + (right ? "end'" : "start'"));
}

/// Each kind of dot once.
void draw_key(Svg& svg, const std::vector<std::string>& factors) {
    double x = kLeft;
    constexpr double kLetter = 6.2;
    for (const Hue& hue : kHues) {
        if (std::find(factors.begin(), factors.end(), hue.colour) == factors.end()) continue;
        svg.circle({x, kTop - 32.0}, kDot, "fill='" + std::string(hue.colour) + "'");
        svg.text({x + kLabelGap, kTop - 28.0}, hue.factor);
        x += 2.2 * kLabelGap + kLetter * static_cast<double>(hue.factor.size());
    }
}

}  // namespace

std::string front_plot(const SceneSweep& sweep, const std::string& light, SweepTruth truth, SweepCost cost) {
    const std::vector<Choice> all = choices(sweep, light, truth, cost);
    if (all.empty()) return "";
    std::vector<double> costs, errors;
    for (const Choice& choice : all) {
        costs.push_back(choice.cost);
        errors.push_back(std::max(choice.error, 1.0e-9));
    }
    const Panel panel{LogScale(costs), LogScale(errors)};
    Svg svg(kLeft + kWide + kRight, kTop + kHigh + kBottom, light + ": error against time");
    draw_axes(svg, panel, truth, cost);
    std::vector<glm::dvec2> front;
    std::vector<std::string> colours;
    for (const Choice& choice : all)
        if (choice.best) front.push_back(panel.at(choice));
    svg.polyline(front, "fill='none' stroke='#333' stroke-width='1.5' stroke-opacity='0.6'");
    for (const Choice& choice : all) {
        const SweepRow& row = sweep.plan[choice.row];
        colours.emplace_back(colour_of(row.factor));
        const bool landmark = row.factor == kDefaultsRow || row.factor == kTutorialFactor;
        svg.open_group("class='dot' data-row='" + std::to_string(choice.row) + "'",
                       row.name + ": " + percent_words(choice.error) + ", x " + short_number(choice.cost));
        const std::string paint = "fill='" + colours.back() + "' fill-opacity='" + (choice.best ? "1" : "0.35") + "'";
        svg.circle(panel.at(choice), landmark || choice.best ? kLargeDot : kDot, paint);
        svg.close_group();
        if (landmark) draw_label(svg, panel.at(choice), row.name, colours.back());
    }
    draw_key(svg, colours);
    return svg.str();
}

}  // namespace gnomon::bench
