#include <algorithm>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "bench/flicker/flicker.h"
#include "bench/text/printf_string.h"
#include "bench/text/svg.h"

namespace gnomon::bench {
namespace {

constexpr const char* kColours[] = {"#c0392b", "#1f6fb2", "#2e8b57", "#8e44ad", "#b8860b", "#555555"};

unsigned long long wide(std::uint64_t count) { return count; }

std::string flips_of(const PathFlicker& r) {
    return formatted("%-5s %-10.10s %-14.14s %-11.11s %7u %10.5f %8llu %8llu %6llu%s%s\n", r.path.c_str(),
                     r.fit.c_str(), r.light.c_str(), r.kind.c_str(), r.points, r.flips_per_point_per_100_frames(),
                     wide(r.flips), wide(r.flips_between_steps), wide(r.edge_flips), r.reason.empty() ? "" : " ",
                     r.reason.c_str());
}

std::string views_of(const PathFlicker& r) {
    return formatted("%-5s %-10.10s %-14.14s %9llu %6llu %6.3f %8.3f %6llu %6llu %6llu %6llu %6llu\n", r.path.c_str(),
                     r.fit.c_str(), r.light.c_str(), wide(r.crossings), wide(r.crossing_flips),
                     r.greatest_crossing_jump, r.greatest_step_jump, wide(r.views), wide(r.views_moved),
                     wide(r.frames_stepped), wide(r.views_drawn), wide(r.uncovered));
}

/// Returns the distinct names in order of first appearance.
template <class Member>
std::vector<std::string> distinct(const std::vector<PathFlicker>& rows, Member member) {
    std::vector<std::string> names;
    for (const PathFlicker& row : rows)
        if (std::find(names.begin(), names.end(), row.*member) == names.end()) names.push_back(row.*member);
    return names;
}

struct Panel {
    glm::dvec2 low, high;
};

/// Flips per point so far, frame by frame.
std::vector<double> running_flips(const PathFlicker& row) {
    std::vector<double> sums;
    double sum = 0.0;
    for (const std::uint32_t flips : row.flips_by_frame) {
        sum += static_cast<double>(flips) / std::max(1.0, static_cast<double>(row.points));
        sums.push_back(sum);
    }
    return sums;
}

void draw_panel(Svg& svg, const Panel& panel, const std::string& title, const std::vector<const PathFlicker*>& rows,
                const std::vector<std::string>& fits) {
    double top = 0.0;
    std::vector<std::vector<double>> curves;
    for (const PathFlicker* row : rows) {
        curves.push_back(running_flips(*row));
        if (!curves.back().empty()) top = std::max(top, curves.back().back());
    }
    svg.rectangle(panel.low, panel.high, "fill='none' stroke='#999'");
    svg.text({panel.low.x, panel.low.y - 6.0}, title);
    svg.text({panel.high.x, panel.low.y - 6.0}, top > 0.0 ? "top " + short_number(top) : "no flip",
             "text-anchor='end' fill='#666'");
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const auto fit = static_cast<std::size_t>(std::find(fits.begin(), fits.end(), rows[r]->fit) - fits.begin());
        const char* colour = kColours[fit % std::size(kColours)];
        const double last = static_cast<double>(std::max<std::size_t>(curves[r].size(), 2) - 1);
        std::vector<glm::dvec2> points;
        for (std::size_t i = 0; i < curves[r].size(); ++i) {
            const double x = static_cast<double>(i) / last, y = top > 0.0 ? curves[r][i] / top : 0.0;
            points.push_back(
                {panel.low.x + (panel.high.x - panel.low.x) * x, panel.high.y - (panel.high.y - panel.low.y) * y});
        }
        svg.polyline(points, "fill='none' stroke-width='1.5' stroke='" + std::string(colour) + "'");
    }
}

nlohmann::ordered_json row_json(const PathFlicker& r) {
    return {{"path", r.path},
            {"fit", r.fit},
            {"light", r.light},
            {"kind", r.kind},
            {"reason", r.reason},
            {"points", r.points},
            {"pairs", r.pairs},
            {"flips", r.flips},
            {"flips_per_point_per_100_frames", r.flips_per_point_per_100_frames()},
            {"still_flips", r.still_flips},
            {"flips_between_steps", r.flips_between_steps},
            {"edge_pairs", r.edge_pairs},
            {"edge_flips", r.edge_flips},
            {"crossings", r.crossings},
            {"crossing_flips", r.crossing_flips},
            {"greatest_jump", r.greatest_jump},
            {"greatest_crossing_jump", r.greatest_crossing_jump},
            {"greatest_step_jump", r.greatest_step_jump},
            {"uncovered", r.uncovered},
            {"views", r.views},
            {"views_moved", r.views_moved},
            {"views_stepped", r.views_stepped},
            {"frames_stepped", r.frames_stepped},
            {"views_drawn", r.views_drawn},
            {"flips_by_frame", r.flips_by_frame}};
}

}  // namespace

std::string stability_table(const Stability& s) {
    std::string text = "scene   " + s.scene + "\ndevice  " + s.device + "\npicture " + std::to_string(s.size_px.x) +
                       " x " + std::to_string(s.size_px.y) + ", " + std::to_string(s.frames) + " frames per path\n\n";
    text += formatted("%-5s %-10s %-14s %-11s %7s %10s %8s %8s %6s\n", "path", "fit", "light", "kind", "points",
                      "flips/100", "flips", "between", "edge");
    for (const PathFlicker& row : s.rows) text += flips_of(row);
    text += formatted("\n%-5s %-10s %-14s %9s %6s %6s %8s %6s %6s %6s %6s %6s\n", "path", "fit", "light", "crossings",
                      "flips", "jump", "at steps", "views", "moved", "steps", "drawn", "uncov.");
    for (const PathFlicker& row : s.rows) text += views_of(row);
    return text + "\nWhat the columns mean: bench stability --help\n";
}

std::string stability_legend() {
    return "Columns of the tables:\n"
           "  flips/100  changes of visibility per point and 100 frames while one view decides\n"
           "  between    flips in frames in which that view did not step\n"
           "  edge       flips within 2^-10 texel of a texel's border or a depth tie, left out\n"
           "  crossings  another view decides than before, or several together; with their flips and greatest jump\n"
           "  at steps   the greatest jump where one of those views stepped\n"
           "  views      summed over frames; moved: their matrices changed; drawn: redrawn\n"
           "  steps      frames in which the size, direction or depth range of some view changed\n"
           "  uncov.     points in view that no view contains, summed over frames\n";
}

std::string stability_json(const Stability& s) {
    nlohmann::ordered_json json;
    json["scene"] = s.scene;
    json["device"] = s.device;
    json["size_px"] = {s.size_px.x, s.size_px.y};
    json["frames"] = s.frames;
    json["rows"] = nlohmann::ordered_json::array();
    for (const PathFlicker& row : s.rows) json["rows"].push_back(row_json(row));
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string stability_plot(const Stability& s) {
    constexpr double kWide = 220.0, kHigh = 120.0, kGapX = 24.0, kGapY = 40.0, kHead = 56.0, kLeft = 16.0;
    const auto paths = distinct(s.rows, &PathFlicker::path), lights = distinct(s.rows, &PathFlicker::light),
               fits = distinct(s.rows, &PathFlicker::fit);
    const double width = kLeft + static_cast<double>(paths.size()) * (kWide + kGapX);
    const double height = kHead + static_cast<double>(lights.size()) * (kHigh + kGapY) + kLeft;
    Svg svg(width, height, "Flips per point");
    svg.text({kLeft, 18.0},
             "Flips per point since the start of the path, over " + std::to_string(s.frames) + " frames");
    for (std::size_t f = 0; f < fits.size(); ++f)
        svg.text({kLeft + 110.0 * static_cast<double>(f), 36.0}, fits[f],
                 "fill='" + std::string(kColours[f % std::size(kColours)]) + "'");
    for (std::size_t l = 0; l < lights.size(); ++l)
        for (std::size_t p = 0; p < paths.size(); ++p) {
            std::vector<const PathFlicker*> rows;
            for (const PathFlicker& row : s.rows)
                if (row.path == paths[p] && row.light == lights[l]) rows.push_back(&row);
            const glm::dvec2 low(kLeft + static_cast<double>(p) * (kWide + kGapX),
                                 kHead + 16.0 + static_cast<double>(l) * (kHigh + kGapY));
            draw_panel(svg, {low, low + glm::dvec2(kWide, kHigh)}, paths[p] + ", " + lights[l], rows, fits);
        }
    return svg.str();
}

}  // namespace gnomon::bench
