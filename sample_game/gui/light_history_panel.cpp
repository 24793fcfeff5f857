#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "sample_game/gui/gui.h"
#include "sample_game/gui/line_plot.h"

namespace gnomon::game {
namespace {

constexpr ImU32 kGpu = IM_COL32(255, 190, 80, 255), kCpu = IM_COL32(120, 170, 255, 255),
                kError = IM_COL32(255, 90, 90, 255), kContract = IM_COL32(120, 220, 120, 160);
const ImVec2 kTimes_px{290.0f, 30.0f}, kErrors_px{200.0f, 30.0f};
// Scales rise by a fifth above what they have to hold, so that the topmost line is seen.
constexpr float kAbove = 1.2f;

std::string ms_words(const LightSample& now, std::optional<float> median_ms) {
    char text[96];
    if (now.gpu_ms)
        std::snprintf(text, sizeof text, "GPU %.2f (median %.2f) CPU %.2f ms", *now.gpu_ms, median_ms.value_or(0.0f),
                      now.cpu_ms);
    else if (median_ms)  // timers of queries come late, and not with every frame
        std::snprintf(text, sizeof text, "GPU - (median %.2f) CPU %.2f ms", *median_ms, now.cpu_ms);
    else
        std::snprintf(text, sizeof text, "GPU not measured, CPU %.2f ms", now.cpu_ms);
    return text;
}

std::string error_words(const LightSample& now) {
    if (!now.error_px) return "no shadow";
    char text[48];
    std::snprintf(text, sizeof text, "edges off by at most %.2f px", *now.error_px);
    return text;
}

float said_px(const LightShadow& shadow) { return shadow.max_error_px > 0.0f ? shadow.max_error_px : 1.0f; }

std::optional<float> contract_of(const GameWorld& world, const std::string& name) {
    for (const NamedEntity& light : world.scene.lights)
        if (light.name == name)
            if (const LightShadow* shadow = world.registry.get<LightShadow>(light.entity)) return said_px(*shadow);
    return std::nullopt;
}

}  // namespace

void draw_light_graph(const GameWorld& world, const LightGraph& graph) {
    if (!ImGui::CollapsingHeader("time and error of each light, last 240 frames", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    const float most_ms = kAbove * graph.most_ms(), most_px = kAbove * graph.most_error_px();
    if (!ImGui::BeginTable("graph", 3, ImGuiTableFlags_SizingFixedFit)) return;
    for (const LightLine& line : graph.lines()) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(line.name().c_str());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(ms_words(line.latest(), line.median_gpu_ms()).c_str());
        Plot times(kTimes_px, most_ms);
        times.line(line.size(), LightLine::kFrames, kCpu, [&](std::size_t i) { return std::optional(line[i].cpu_ms); });
        times.line(line.size(), LightLine::kFrames, kGpu, [&](std::size_t i) { return line[i].gpu_ms; });
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(error_words(line.latest()).c_str());
        Plot errors(kErrors_px, most_px);
        if (const auto contract = contract_of(world, line.name())) errors.level(*contract, kContract);
        errors.line(line.size(), LightLine::kFrames, kError, [&](std::size_t i) { return line[i].error_px; });
    }
    ImGui::EndTable();
    ImGui::Text("fields' heights: %.2f ms and %.2f px;", static_cast<double>(most_ms), static_cast<double>(most_px));
    const std::pair<ImU32, const char*> lines[] = {
        {kGpu, "GPU"}, {kCpu, "CPU"}, {kError, "error"}, {kContract, "target"}};
    for (const auto& [colour, words] : lines) {
        ImGui::SameLine();
        ImGui::TextColored(ImColor(colour), "%s", words);
    }
}

}  // namespace gnomon::game
