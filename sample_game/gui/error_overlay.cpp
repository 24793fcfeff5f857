#include "sample_game/gui/error_overlay.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "sample_game/gui/imgui_renderer.h"

namespace gnomon::game {
namespace {

constexpr ImU32 kBehind = IM_COL32(10, 10, 14, 215), kInk = IM_COL32(230, 225, 210, 255),
                kChosen = IM_COL32(255, 225, 140, 255), kBar = IM_COL32(120, 170, 255, 255);
constexpr float kAir_px = 6.0f, kBar_px = 6.0f;

struct LegendRow {
    ImU32 colour;
    const char* meaning;
};
constexpr std::array kLegend{
    LegendRow{IM_COL32(255, 40, 40, 255), "false shadow"}, LegendRow{IM_COL32(60, 120, 255, 255), "false light"},
    LegendRow{IM_COL32(255, 220, 0, 255), "not covered"}, LegendRow{IM_COL32(255, 255, 255, 255), "truth unsure"}};

/// A box of lines in the picture's upper right corner; the font is of one width.
class Words {
public:
    void add(const std::string& line, ImU32 colour = kInk) { lines_.push_back({line, colour}); }

    /// Draws the box, `more_px` higher than its lines. Returns the place below the last line.
    ImVec2 draw(glm::vec2 size_px, float more_px) const {
        float width = 0.0f;
        for (const Line& line : lines_) width = std::max(width, ImGui::CalcTextSize(line.text.c_str()).x);
        const float height = ImGui::GetTextLineHeight();
        ImDrawList& list = *ImGui::GetBackgroundDrawList();
        const ImVec2 low{std::max(size_px.x - width - 3.0f * kAir_px, 0.0f), kAir_px};
        const ImVec2 high{size_px.x - kAir_px, low.y + 2.0f * kAir_px + static_cast<float>(lines_.size()) * height};
        list.AddRectFilled(low, {high.x, high.y + more_px}, kBehind);
        ImVec2 at{low.x + kAir_px, low.y + kAir_px};
        for (const Line& line : lines_) {
            list.AddText(at, line.colour, line.text.c_str());
            at.y += height;
        }
        return at;
    }

private:
    struct Line {
        std::string text;
        ImU32 colour;
    };
    std::vector<Line> lines_;
};

/// Returns whether the light has less than it requested, so that the reason belongs beside its errors.
bool has_less(const LightReport& light) {
    return light.state == LightState::degraded || light.state == LightState::skipped;
}

const char* words_of(ShownShare share) {
    if (share == ShownShare::source) return "its source";
    return share == ShownShare::area ? "pixels' areas" : "source and areas";
}

/// Lights with a line of their own. More would hide the picture.
constexpr std::size_t kMostLines = 12;

/// Returns the lights with a line, in the frame's order: the chosen one, then the worst. `others` counts further lights
/// that reach a pixel.
std::vector<std::size_t> listed(const FrozenFrame& frozen, std::size_t& others) {
    const std::vector<JudgedLight>& lights = frozen.lights();
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (!lights[i].judged() || lights[i].scored() > 0 || frozen.chosen() == i) found.push_back(i);
    std::stable_sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
        const bool a_chosen = frozen.chosen() == a, b_chosen = frozen.chosen() == b;
        return a_chosen != b_chosen ? a_chosen : lights[a].wrong() > lights[b].wrong();
    });
    others = found.size() - std::min(found.size(), kMostLines);
    found.resize(found.size() - others);
    std::sort(found.begin(), found.end());
    return found;
}

/// Returns whether a light's colours behind glass are judged, so that they have a column.
bool any_tint(const FrozenFrame& frozen) {
    return std::any_of(frozen.lights().begin(), frozen.lights().end(),
                       [](const JudgedLight& light) { return light.tint.has_value(); });
}

/// Columns before a light's figures: its name, cut where the picture is narrow.
int name_width(const FrozenFrame& frozen, const std::vector<std::size_t>& lights, float width_px) {
    constexpr float kMost = 32.0f, kFigures = 72.0f, kTint = 9.0f;
    const float least = any_tint(frozen) ? 10.0f : 14.0f;
    const float room = width_px / ImGui::CalcTextSize("m").x - kFigures - (any_tint(frozen) ? kTint : 0.0f);
    std::size_t longest = 0;
    for (const std::size_t i : lights) longest = std::max(longest, frozen.lights()[i].name.size());
    return static_cast<int>(std::clamp(std::min(static_cast<float>(longest), room), least, kMost));
}

/// Returns the mean error of colours behind glass, percent, as a column; empty: not judged.
std::string tint_figure(const JudgedLight& light) {
    if (!light.tint) return {};
    char text[32];
    std::snprintf(text, sizeof text, " %8.4f", 100.0 * light.tint->tinted_error);
    return text;
}

std::string figures(const JudgedLight& light, const LightReport& report, int width) {
    char text[224];
    if (light.soft) {
        const truth::SoftMetrics& m = *light.soft;
        std::snprintf(text, sizeof text, "%-*.*s by %s: mean error %.3f %%, where partly lit %.2f %%, leak %.3f %%",
                      width, width, light.name.c_str(), words_of(light.by), 100.0 * m.mean_error,
                      100.0 * m.penumbra_error, 100.0 * m.umbra_leak);
        return light.tint ? text + (", glass" + tint_figure(light) + " %") : text;
    }
    if (!light.metrics) {
        std::snprintf(text, sizeof text, "%-*.*s %s", width, width, light.name.c_str(),
                      light.stale ? "is being read" : "its visibility cannot be read");
        return text;
    }
    const truth::Metrics& m = *light.metrics;
    const auto percent = [&](std::size_t pixels) { return 100.0 * m.fraction(pixels); };
    std::snprintf(text, sizeof text, "%-*.*s %8.4f %8.4f %8.4f %8.4f %8.4f %7.2f %9.2f%s %s", width, width,
                  light.name.c_str(), percent(m.wrong), percent(m.false_shadow), percent(m.false_light),
                  percent(m.acne), percent(m.leak), m.edge.max_px, report.predicted_error_px,
                  tint_figure(light).c_str(), has_less(report) ? reason_code(report.reason) : "");
    return text;
}

void draw_legend(ImVec2 at) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float side = ImGui::GetTextLineHeight();
    for (const LegendRow& row : kLegend) {
        list.AddRectFilled(at, {at.x + side, at.y + side}, row.colour);
        list.AddText({at.x + side + kAir_px, at.y}, kInk, row.meaning);
        at.x += side + 3.0f * kAir_px + ImGui::CalcTextSize(row.meaning).x;
    }
}

void draw_progress(const FrozenFrame& frozen, glm::vec2 size_px) {
    Words words;
    char text[64];
    std::snprintf(text, sizeof text, "tracing the truth: %3.0f %%   F5 cancels", 100.0 * frozen.share());
    words.add(text);
    const ImVec2 at = words.draw(size_px, kBar_px);
    const float whole_px = ImGui::CalcTextSize(text).x;
    const float done_px = whole_px * static_cast<float>(std::clamp(frozen.share(), 0.0, 1.0));
    ImGui::GetBackgroundDrawList()->AddRectFilled(at, {at.x + done_px, at.y + kBar_px}, kBar);
}

void draw_figures(const FrozenFrame& frozen, const FrameReport& report, glm::vec2 size_px) {
    Words words;
    std::size_t others = 0;
    const std::vector<std::size_t> lights = listed(frozen, others);
    const int width = name_width(frozen, lights, size_px.x);
    words.add("against ray-traced truth, frozen: F5 goes on, F2 shows the next light");
    char head[128];
    std::snprintf(head, sizeof head, "  %-*s %8s %8s %8s %8s %8s %7s %9s%s", width, "light", "wrong %", "f.shad %",
                  "f.lit %", "acne %", "leak %", "edge px", "predicted", any_tint(frozen) ? "  glass %" : "");
    words.add(head);
    words.add(frozen.chosen() ? "  each pixel's worst" : "> each pixel's worst", frozen.chosen() ? kInk : kChosen);
    for (const std::size_t i : lights) {
        const JudgedLight& light = frozen.lights()[i];
        const auto of = std::find_if(report.lights.begin(), report.lights.end(),
                                     [&](const LightReport& other) { return other.entity == light.entity; });
        const bool chosen = frozen.chosen() == i;
        words.add((chosen ? "> " : "  ") + figures(light, of == report.lights.end() ? LightReport{} : *of, width),
                  chosen ? kChosen : kInk);
    }
    if (others > 0) words.add("  " + std::to_string(others) + " more err no more than these");
    if (lights.size() + others < frozen.lights().size())
        words.add("  " + std::to_string(frozen.lights().size() - lights.size() - others) + " more reach no pixel");
    const float legend_px = ImGui::GetTextLineHeight() + 2.0f * kAir_px;
    const ImVec2 below = words.draw(size_px, legend_px);
    draw_legend({below.x, below.y + kAir_px});
}

}  // namespace

void ErrorLayer::forget() {
    if (image_ != 0) destroy_image(image_);
    image_ = 0;
}

void ErrorLayer::upload(const FrozenFrame& frozen) {
    if (image_ != 0 && version_ == frozen.version()) return;
    forget();
    version_ = frozen.version();
    image_ = make_image("shadow errors", frozen.size_px(), frozen.tints().data(), true);
}

void ErrorLayer::draw(const FrozenFrame& frozen, const FrameReport& report, glm::vec2 size_px) {
    if (frozen.state() != FrozenFrame::State::shown || frozen.tints().empty()) {
        forget();
        if (frozen.on()) draw_progress(frozen, size_px);
        return;
    }
    upload(frozen);
    if (image_ != 0)  // without memory for it the figures are still there
        ImGui::GetBackgroundDrawList()->AddImage(image_of(image_), {0.0f, 0.0f}, {size_px.x, size_px.y}, {0.0f, 1.0f},
                                                 {1.0f, 0.0f});
    draw_figures(frozen, report, size_px);
}

}  // namespace gnomon::game
