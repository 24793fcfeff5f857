#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "sample_game/gui/gui.h"

namespace gnomon::game {
namespace {

constexpr double kBytesPerMiB = 1024.0 * 1024.0;
// Ends of the sliders: the memory of today's largest devices, and more time than any frame should take.
constexpr float kMost_MiB = 4096.0f, kMost_ms = 100.0f;
constexpr float kWidth_px = 240.0f;

const char* bytes_format(const shadow::ShadowBudget& budget) {
    if (budget.bytes == shadow::ShadowBudget::kUnlimited) return "no bound";
    return budget.bytes > 0 ? "%.1f" : "automatic";
}

void draw_sliders(shadow::ShadowBudget& budget) {
    const auto flags = ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoInput;
    auto mib = static_cast<float>(static_cast<double>(budget.bytes) / kBytesPerMiB);
    ImGui::PushItemWidth(kWidth_px);
    if (ImGui::SliderFloat("maps, MiB", &mib, 0.0f, kMost_MiB, bytes_format(budget), flags))
        budget.bytes =
            static_cast<std::uint64_t>(std::llround(static_cast<double>(std::max(mib, 0.0f)) * kBytesPerMiB));
    float ms = budget.gpu_ms;
    if (ImGui::SliderFloat("GPU, ms per frame", &ms, 0.0f, kMost_ms, ms > 0.0f ? "%.2f" : "no bound", flags))
        budget.gpu_ms = std::max(ms, 0.0f);
    ImGui::PopItemWidth();
    if (ImGui::Button("defaults")) budget = {};
}

std::string from_to(std::uint64_t wanted, std::uint64_t given) {
    return wanted == given ? std::to_string(given) : std::to_string(wanted) + " > " + std::to_string(given);
}

/// Draws a table of lights: what each requested, what the budget left it, and the reason.
void draw_grants(const FrameReport& report) {
    constexpr const char* kColumns[] = {"light", "state", "reason", "px",         "views",
                                        "KiB",   "us",    "taps",   "drawn 1 in", "wrong % (model)"};
    const auto flags = ImGuiTableFlags_Borders | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
    if (!ImGui::BeginTable("grants", static_cast<int>(std::size(kColumns)), flags)) return;
    for (const char* column : kColumns) ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    const auto cell = [](const std::string& text) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(text.c_str());
    };
    for (const LightReport& light : report.lights) {
        ImGui::TableNextRow();
        cell(light.name);
        cell(to_text(light.state));
        cell(reason_code(light.reason));
        if (!light.budget) continue;
        const BudgetReport& b = *light.budget;
        cell(from_to(b.wanted_px, b.px));
        cell(from_to(b.wanted_views, b.views));
        cell(from_to(b.wanted_bytes / 1024, b.bytes / 1024));
        cell(from_to(static_cast<std::uint64_t>(b.wanted_us), static_cast<std::uint64_t>(b.us)));
        cell(b.plain ? "one" : "all");
        cell(std::to_string(b.refresh_frames));
        ImGui::TableNextColumn();
        ImGui::Text("%.3f", 100.0 * b.harm);
    }
    ImGui::EndTable();
}

}  // namespace

void draw_budget(const FrameReport& report, shadow::ShadowBudget& budget) {
    if (!ImGui::CollapsingHeader("budgets")) return;
    draw_sliders(budget);
    const bool limits = std::any_of(report.lights.begin(), report.lights.end(),
                                    [](const LightReport& light) { return light.budget.has_value(); });
    if (budget == shadow::ShadowBudget{} && !limits)
        ImGui::TextUnformatted("every light gets what it requests");
    else
        draw_grants(report);
}

}  // namespace gnomon::game
