#include <algorithm>

#include "bench/compare/filter_comparison.h"
#include "bench/text/printf_string.h"

namespace gnomon::bench {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between = ", ") {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
    return all;
}

std::string ratio(const Spread& spread) { return spread.count == 0 ? "-" : formatted("%.2f", spread.median); }
std::string count(const Figure& number) { return number ? formatted("%.0f", *number) : std::string("-"); }
std::string percent(const std::optional<double>& share) {
    return share ? formatted("%.3f", kPercent * *share) : std::string("-");
}

std::string size_name(std::uint32_t resolution_px) {
    return resolution_px == 0 ? "its own size" : std::to_string(resolution_px) + " texels";
}

/// Joins one value per light, with strokes between them.
template <typename F>
std::string each_light(const std::vector<RowFigures>& lights, const F& value) {
    std::vector<std::string> values;
    for (const RowFigures& light : lights) values.push_back(value(light));
    const bool same = std::all_of(values.begin(), values.end(), [&](const auto& v) { return v == values.front(); });
    return same && !values.empty() ? values.front() : joined(values, " / ");
}

/// Names the truths, lights and times for which a variant is on the front; "never": none.
std::string best_when(const FilterRows& rows, std::size_t resolution, std::size_t variant) {
    std::vector<std::string> truths;
    for (const RowTruth truth : kRowTruths) {
        std::vector<std::string> lights;
        std::size_t full = 0;
        for (std::size_t l = 0; l < rows.lights.size(); ++l) {
            const bool drawn = rows.front(resolution, l, truth, RowCost::drawn)[variant] != 0;
            const bool kept = rows.front(resolution, l, truth, RowCost::kept)[variant] != 0;
            full += drawn && kept;
            if (drawn || kept) lights.push_back(rows.lights[l] + (drawn ? kept ? "" : " drawn" : " kept"));
        }
        const char* name = truth == RowTruth::point ? "point" : "disk";
        if (full == rows.lights.size()) lights = {"all"};
        if (!lights.empty()) truths.push_back(std::string(name) + ": " + joined(lights));
    }
    return truths.empty() ? "never" : joined(truths, "; ");
}

/// Returns the table of one size of maps: a line per variant.
std::string markdown_of(const FilterRows& rows, std::size_t resolution) {
    std::string table = "Maps of " + size_name(rows.resolutions_px[resolution]) + "; " + joined(rows.lights, " / ") +
                        ":\n\n| filter | taps | MB | time drawn | time kept | wrong % | off the disk % | best when "
                        "|\n|---|---|---|---|---|---|---|---|\n";
    constexpr double kBytesPerMb = 1.0e6;
    for (std::size_t v = 0; v < rows.variants.size(); ++v) {
        const std::vector<RowFigures>& lights = rows.figures[resolution][v];
        table += "| `" + rows.variants[v].name + "`";
        for (const std::string& cell :
             {each_light(lights, [](const RowFigures& f) { return count(f.taps); }),
              each_light(lights,
                         [](const RowFigures& f) { return formatted("%.0f", f.bytes.value_or(0.0) / kBytesPerMb); }),
              each_light(lights, [](const RowFigures& f) { return ratio(f.gpu_ratio); }),
              each_light(lights, [](const RowFigures& f) { return ratio(f.kept_ratio); }),
              each_light(lights, [](const RowFigures& f) { return percent(f.wrong); }),
              each_light(lights, [](const RowFigures& f) { return percent(f.disk_error); }),
              best_when(rows, resolution, v)})
            table += " | " + cell;
        table += " |\n";
    }
    return table;
}

/// Lists the variants that are best at some cost, and the beaten ones, for one light and one size of maps.
std::string fronts_of(const FilterRows& rows, std::size_t resolution, std::size_t light) {
    std::string lines = rows.lights[light] + ", maps of " + size_name(rows.resolutions_px[resolution]) + "\n";
    for (const RowTruth truth : kRowTruths)
        for (const RowCost cost : kRowCosts) {
            std::vector<std::string> best, beaten;
            const std::vector<std::uint8_t> front = rows.front(resolution, light, truth, cost);
            for (std::size_t v = 0; v < front.size(); ++v)
                if (rows.is_judged(resolution, v, light, truth))
                    (front[v] ? best : beaten).push_back(rows.variants[v].name);
            lines += formatted("  %s, maps %s: on the front ", truth == RowTruth::point ? "point" : "disk",
                               cost == RowCost::drawn ? "drawn anew" : "kept") +
                     joined(best) + "\n    beaten " + joined(beaten) + "\n";
        }
    return lines;
}

std::string never_line(const FilterRows& rows) {
    const std::vector<std::string> never = rows.never_best();
    return "Never the best choice at any cost: " + (never.empty() ? std::string("none") : joined(never)) + ".\n";
}

}  // namespace

std::string filter_rows_table(const FilterRows& rows) {
    std::string table =
        formatted("scene   %s\ndevice  %s\npicture %u x %u\n\n%-24s %5s %6s %-18s %7s %8s %9s %8s %9s %9s\n",
                  rows.scene.c_str(), rows.device.c_str(), rows.size_px.x, rows.size_px.y, "filter", "taps", "size",
                  "light", "MB", "x drawn", "x kept", "wrong%", "blur%", "disk%");
    constexpr double kBytesPerMb = 1.0e6;
    for (std::size_t r = 0; r < rows.resolutions_px.size(); ++r)
        for (std::size_t v = 0; v < rows.variants.size(); ++v)
            for (std::size_t l = 0; l < rows.lights.size(); ++l) {
                const RowFigures& f = rows.figures[r][v][l];
                const std::uint32_t size_px = rows.resolutions_px[r];
                table += formatted("%-24s %5s %6s %-18.18s %7.2f %8s %9s %8s %9s %9s\n", rows.variants[v].name.c_str(),
                                   count(f.taps).c_str(), size_px == 0 ? "own" : std::to_string(size_px).c_str(),
                                   rows.lights[l].c_str(), f.bytes.value_or(0.0) / kBytesPerMb,
                                   ratio(f.gpu_ratio).c_str(), ratio(f.kept_ratio).c_str(), percent(f.wrong).c_str(),
                                   percent(f.mean_error).c_str(), percent(f.disk_error).c_str());
            }
    table +=
        "\nx drawn, x kept: time of the depth and lighting pass over that of `hard` at the same size, medians of "
        "rounds, "
        "every\nview drawn anew, and maps kept. wrong: on the other side of 1/2 than the truth about a point; blur: "
        "mean "
        "difference\nfrom it; disk: from the truth about " +
        joined(disk_source()) + ".\n\n";
    for (std::size_t l = 0; l < rows.lights.size(); ++l)
        for (std::size_t r = 0; r < rows.resolutions_px.size(); ++r) table += fronts_of(rows, r, l);
    return table + "\n" + never_line(rows);
}

std::string filter_rows_markdown(const FilterRows& rows) {
    std::string tables;
    for (std::size_t r = 0; r < rows.resolutions_px.size(); ++r) tables += markdown_of(rows, r) + "\n";
    return tables + never_line(rows);
}

}  // namespace gnomon::bench
