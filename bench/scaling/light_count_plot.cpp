#include <algorithm>
#include <cmath>
#include <functional>

#include "bench/common/units.h"
#include "bench/scaling/light_count.h"
#include "bench/text/svg.h"

namespace gnomon::bench {
namespace {

constexpr double kWide = 250.0, kHigh = 130.0, kLeft = 64.0, kTop = 64.0, kGapX = 32.0, kGapY = 34.0, kBottom = 40.0;
constexpr std::array kColours = {"#555555", "#1f6fb2", "#c0392b"};  // per mode

struct Quantity {
    std::string title;
    std::function<double(const DemandFigures&)> of;
};

std::vector<Quantity> quantities() {
    return {{"frame, ms", [](const DemandFigures& f) { return f.frame_us.median / kUsPerMs; }},
            {"shadow stages, ms of CPU", [](const DemandFigures& f) { return f.shadow_cpu_us.median / kUsPerMs; }},
            {"draws of depth passes", [](const DemandFigures& f) { return static_cast<double>(f.draws); }},
            {"MiB of maps", [](const DemandFigures& f) { return static_cast<double>(f.bytes) / kBytesPerMiB; }}};
}

/// Whole decades around what is shown. What is 0 lies below the lowest of them.
struct LogAxis {
    double low = 0.0, high = 1.0;  // powers of ten
    double share(double value) const { return value > 0.0 ? (std::log10(value) - low) / (high - low) : 0.0; }
};

LogAxis axis_around(const std::vector<double>& values) {
    double least = INFINITY, most = 0.0;
    for (const double v : values)
        if (v > 0.0) least = std::min(least, v), most = std::max(most, v);
    if (!(most > 0.0)) return {};
    const double low = std::floor(std::log10(least));
    return {low, std::max(low + 1.0, std::ceil(std::log10(most)))};
}

struct Panel {
    glm::dvec2 corner;
    LogAxis x, y;
    glm::dvec2 at(double lights, double value) const {
        return corner + glm::dvec2(kWide * x.share(lights), kHigh * (1.0 - y.share(value)));
    }
};

void draw_axes(Svg& svg, const Panel& panel, bool first, bool last) {
    constexpr const char* kGrid = "stroke='#ddd'";
    for (double power = panel.x.low; power <= panel.x.high; power += 1.0) {
        const double lights = std::pow(10.0, power);
        const glm::dvec2 foot(panel.at(lights, 0.0).x, panel.corner.y + kHigh);
        svg.line(foot, {foot.x, panel.corner.y}, kGrid);
        if (last) svg.text(foot + glm::dvec2(0.0, 16.0), short_number(lights), "text-anchor='middle'");
    }
    for (double power = panel.y.low; power <= panel.y.high; power += 1.0) {
        const double y = panel.corner.y + kHigh * (1.0 - (power - panel.y.low) / (panel.y.high - panel.y.low));
        svg.line({panel.corner.x, y}, {panel.corner.x + kWide, y}, kGrid);
        if (first) svg.text({panel.corner.x - 6.0, y + 4.0}, short_number(std::pow(10.0, power)), "text-anchor='end'");
    }
    svg.rectangle(panel.corner, panel.corner + glm::dvec2(kWide, kHigh), "fill='none' stroke='#999'");
}

/// Draws a curve. A value of 0 is a ring on the lowest line, and no line leads to it.
void draw_curve(Svg& svg, const Panel& panel, const std::vector<glm::dvec2>& lights_and_values, const char* colour) {
    const std::string paint = "'" + std::string(colour) + "'";
    std::vector<glm::dvec2> points;
    for (const glm::dvec2& p : lights_and_values) {
        const bool none = !(p.y > 0.0);
        const glm::dvec2 at = panel.at(p.x, p.y);
        svg.circle(at, 3.0, none ? "fill='#fff' stroke=" + paint : "fill=" + paint);
        if (!none) points.push_back(at);
    }
    svg.polyline(points, "fill='none' stroke-width='1.5' stroke=" + paint);
}

void draw_head(Svg& svg) {
    svg.text({kLeft, 20.0}, "What shadows cost by the number of lights", "font-weight='bold'");
    for (std::size_t m = 0; m < kDemandModes.size(); ++m)
        svg.text({kLeft + 110.0 * static_cast<double>(m), 38.0}, to_text(kDemandModes[m]),
                 "fill='" + std::string(kColours[m]) + "'");
    svg.text({kLeft + 110.0 * static_cast<double>(kDemandModes.size()), 38.0}, "ring: 0");
}

}  // namespace

std::string demand_plot(const Demand& demand) {
    const std::vector<Quantity> shown = quantities();
    std::vector<double> lights;
    for (const DemandRow& row : demand.rows) lights.push_back(row.lights);
    const double rows = static_cast<double>(shown.size());
    Svg svg(kLeft + static_cast<double>(kDemandMotions.size()) * (kWide + kGapX),
            kTop + rows * (kHigh + kGapY) + kBottom, "Shadows and lights");
    draw_head(svg);
    for (std::size_t q = 0; q < shown.size(); ++q) {
        std::vector<double> values;
        for (const DemandRow& row : demand.rows)
            for (const auto& modes : row.figures)
                for (const DemandFigures& figures : modes) values.push_back(shown[q].of(figures));
        for (std::size_t c = 0; c < kDemandMotions.size(); ++c) {
            const glm::dvec2 corner(kLeft + static_cast<double>(c) * (kWide + kGapX),
                                    kTop + 12.0 + static_cast<double>(q) * (kHigh + kGapY));
            const Panel panel{corner, axis_around(lights), axis_around(values)};
            svg.text(corner - glm::dvec2(0.0, 5.0), std::string(to_text(kDemandMotions[c])) + ": " + shown[q].title);
            draw_axes(svg, panel, c == 0, q + 1 == shown.size());
            for (std::size_t m = 0; m < kDemandModes.size(); ++m) {
                std::vector<glm::dvec2> curve;
                for (const DemandRow& row : demand.rows)
                    curve.emplace_back(row.lights, shown[q].of(row.of(kDemandMotions[c], kDemandModes[m])));
                draw_curve(svg, panel, curve, kColours[m]);
            }
        }
    }
    svg.text({kLeft + 0.5 * static_cast<double>(kDemandMotions.size()) * (kWide + kGapX),
              kTop + 12.0 + rows * (kHigh + kGapY) + 12.0},
             "lights", "text-anchor='middle'");
    return svg.str();
}

}  // namespace gnomon::bench
