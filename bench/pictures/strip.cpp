#include "bench/pictures/strip.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "bench/common/png_file.h"
#include "bench/compare/crop_images.h"
#include "bench/compare/evaluate_configuration.h"
#include "bench/text/printf_string.h"

namespace gnomon::bench {
namespace {

constexpr glm::uvec2 kPicture_px{288, 192};
constexpr std::uint32_t kStripGap_px = 4;
using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kPaper{255, 255, 255}, kWrong{235, 40, 30};

/// Returns what most tutorials teach: one map of 1024 texels around all that is seen, 3 x 3 taps and their bias.
std::vector<std::string> tutorial_settings() {
    return {"filter=pcf_grid", "filter_size=3", "bias=tutorial_cosine", "resolution=1024",
            "fit=stable",      "cascades=1",    "caster_faces=both"};
}

std::optional<Error> judge(Stage& stage, const TracedTruths& truths, StripColumn& column) {
    JudgeOptions options;
    options.edges = false;
    options.on_measured = [&](const TracedLight& light, const std::vector<float>& measured) {
        if (column.rgba.empty()) (void)stage.frame().read_picture(column.rgba);
        column.wrong.resize(measured.size(), 0);
        StripLight& judged = column.lights.emplace_back(StripLight{light.name});
        for (std::size_t i = 0; i < measured.size(); ++i) {
            judged.scored += light.point.scored[i] && !light.point.ambiguous[i];
            if (!is_wrong(light, i, measured[i])) continue;
            ++judged.wrong;
            column.wrong[i] = 1;
        }
    };
    const JudgedRow row = judge_row(stage, truths, {column.name, column.settings}, options);
    if (row.error) return Error{*row.error, stage.scene_name(), "", "bench.strip"};
    if (column.rgba.size() != column.wrong.size() * 4)
        return Error{"the picture cannot be read", stage.scene_name(), "", "bench.strip"};
    return std::nullopt;
}

std::string percent_text(double share) {
    char text[32];
    const double percent = kPercent * share;
    std::snprintf(text, sizeof text, percent >= 1.0 ? "%.1f %%" : percent > 0.0 ? "%.2g %%" : "0", percent);
    return text;
}

}  // namespace

double StripColumn::share() const {
    std::size_t scored = 0, off = 0;
    for (const StripLight& light : lights) {
        scored += light.scored;
        off += light.wrong;
    }
    return scored > 0 ? static_cast<double>(off) / static_cast<double>(scored) : 0.0;
}

Result<Strip> make_strip(Stage& stage) {
    const auto truths = trace_truths(stage);
    if (!truths) return truths.error();
    Strip strip;
    strip.scene = stage.scene_name();
    strip.device = stage.device().info().name;
    strip.size_px = truths.value().hits.size_px;
    strip.part_px = glm::min(kPicture_px, strip.size_px);
    if (truths.value().lights.empty()) return Error{"no light has a shadow", strip.scene, "", "bench.strip"};
    strip.part_low_px = shown_part(truths.value().lights.front().point, strip.size_px, strip.part_px);
    strip.columns = {{"tutorial", tutorial_settings(), {}, {}, {}},
                     {"gnomon", {}, {}, {}, {}},
                     {"truth", {"filter=exact"}, {}, {}, {}}};
    for (StripColumn& column : strip.columns)
        if (auto error = judge(stage, truths.value(), column)) return *error;
    if (strip.columns.back().share() > 0.0)
        return Error{"rays leave pixels wrong: this column is no truth", strip.scene, "", "bench.truth"};
    return strip;
}

std::optional<Error> write_strip(const Strip& strip, const std::filesystem::path& file) {
    const glm::uvec2 part = strip.part_px;
    const auto columns = static_cast<std::uint32_t>(strip.columns.size());
    const glm::uvec2 size_px{columns * part.x + (columns - 1) * kStripGap_px, 2 * part.y + kStripGap_px};
    std::vector<std::uint8_t> rgba;
    for (std::uint32_t y = 0; y < size_px.y; ++y)
        for (std::uint32_t x = 0; x < size_px.x; ++x) {
            const glm::uvec2 cell{x / (part.x + kStripGap_px), y / (part.y + kStripGap_px)};
            const glm::uvec2 in{x % (part.x + kStripGap_px), y % (part.y + kStripGap_px)};
            Rgb colour = kPaper;
            if (in.x < part.x && in.y < part.y) {
                const StripColumn& column = strip.columns[cell.x];
                const std::size_t px = strip.part_low_px.x + in.x;
                const std::size_t from_bottom = strip.part_low_px.y + part.y - 1 - in.y;
                const std::uint8_t* drawn =
                    &column.rgba[((strip.size_px.y - 1 - from_bottom) * strip.size_px.x + px) * 4];
                colour = {drawn[0], drawn[1], drawn[2]};
                const auto grey = static_cast<std::uint8_t>((2 * drawn[0] + 5 * drawn[1] + drawn[2]) / 16);
                if (cell.y == 1)
                    colour = column.wrong[from_bottom * strip.size_px.x + px] ? kWrong : Rgb{grey, grey, grey};
            }
            rgba.insert(rgba.end(), {colour[0], colour[1], colour[2], 255});
        }
    return write_png(file, size_px.x, size_px.y, rgba);
}

std::string strip_table(const Strip& strip) {
    std::string text = "| wrong pixels of |";
    for (const StripColumn& column : strip.columns) text += " " + column.name + " |";
    text += "\n|---|";
    for (std::size_t i = 0; i < strip.columns.size(); ++i) text += "---|";
    text += "\n";
    for (std::size_t k = 0; k < strip.columns.front().lights.size(); ++k) {
        text += "| " + strip.columns.front().lights[k].name + " |";
        for (const StripColumn& column : strip.columns) {
            const StripLight& light = column.lights[k];
            const auto scored = static_cast<double>(std::max<std::size_t>(light.scored, 1));
            text += " " + percent_text(static_cast<double>(light.wrong) / scored) + " |";
        }
        text += "\n";
    }
    text += "| all lights |";
    for (const StripColumn& column : strip.columns) text += " " + percent_text(column.share()) + " |";
    return text + "\n";
}

std::string strip_json(const Strip& strip) {
    nlohmann::ordered_json figures;
    for (const StripColumn& column : strip.columns) {
        figures["strip." + column.name] = percent_text(column.share());
        for (const StripLight& light : column.lights) {
            const auto scored = static_cast<double>(std::max<std::size_t>(light.scored, 1));
            figures["strip." + column.name + "." + light.name] =
                percent_text(static_cast<double>(light.wrong) / scored);
        }
    }
    constexpr int kIndent = 1;
    const nlohmann::ordered_json json = {{"scene", strip.scene},
                                         {"device", strip.device},
                                         {"size_px", {strip.size_px.x, strip.size_px.y}},
                                         {"figures", figures}};
    return json.dump(kIndent) + "\n";
}

}  // namespace gnomon::bench
