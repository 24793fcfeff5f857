#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string>

#include "sample_game/gui/gui.h"
#include "sample_game/gui/line_plot.h"
#include "sample_game/support/settings/presets.h"

namespace gnomon::game {
namespace {

constexpr ImU32 kDrawn = IM_COL32(255, 190, 80, 255), kKept = IM_COL32(120, 170, 255, 255),
                kNow = IM_COL32(120, 220, 120, 200);
const ImVec2 kPlot_px{400.0f, 70.0f};
constexpr float kAbove = 1.2f;

bool is_meant(const NamedEntity& light, const ContractState& state) {
    return state.light.empty() || light.name == state.light;
}

/// Returns the max_error_px that all chosen lights share; 0: none has a target. Empty: they differ, or there is no
/// light.
std::optional<float> common_px(const GameWorld& world, const ContractState& state) {
    std::optional<float> common;
    for (const NamedEntity& light : world.scene.lights) {
        const LightShadow* shadow = world.registry.get<LightShadow>(light.entity);
        if (!shadow || !is_meant(light, state)) continue;
        if (common && (*common < shadow->max_error_px || *common > shadow->max_error_px)) return std::nullopt;
        common = shadow->max_error_px;
    }
    return common;
}

/// Changes the settings of every chosen light.
template <class Change>
void change(GameWorld& world, const ContractState& state, const Change& changed) {
    for (const NamedEntity& light : world.scene.lights)
        if (is_meant(light, state)) change_settings(world.registry, light.entity, changed);
}

/// Returns whether a chosen light has a map size of its own, so that it does not follow max_error_px.
bool is_given(const GameWorld& world, const ContractState& state) {
    for (const NamedEntity& light : world.scene.lights) {
        const LightShadow* shadow = world.registry.get<LightShadow>(light.entity);
        if (shadow && is_meant(light, state) && shadow->resolution_px > 0) return true;
    }
    return false;
}

void draw_light_choice(const GameWorld& world, ContractState& state) {
    if (!ImGui::BeginCombo("light", state.light.empty() ? "all" : state.light.c_str())) return;
    if (ImGui::Selectable("all", state.light.empty())) state.light.clear();
    for (const NamedEntity& light : world.scene.lights)
        if (world.registry.has<LightShadow>(light.entity) &&
            ImGui::Selectable(light.name.c_str(), state.light == light.name))
            state.light = light.name;
    ImGui::EndCombo();
}

const Preset* common_preset(const GameWorld& world, const ContractState& state) {
    const Preset* common = nullptr;
    for (const NamedEntity& light : world.scene.lights) {
        const std::optional<LightSettings> settings = settings_of(world.registry, light.entity);
        if (!settings || !is_meant(light, state)) continue;
        const Preset* own = preset_of(*settings);
        if (!own || (common && own != common)) return nullptr;
        common = own;
    }
    return common;
}

void draw_presets(GameWorld& world, ContractState& state) {
    const Preset* now = common_preset(world, state);
    for (const Preset& preset : presets()) {
        if (ImGui::RadioButton(preset.name, now == &preset))
            change(world, state, [&](LightSettings& settings) { apply_preset(preset, settings); });
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", preset.meaning);
        ImGui::SameLine();
    }
    ImGui::TextUnformatted(now ? "preset" : "preset: none of these");
}

std::string px_words(std::optional<float> px) {
    if (!px) return "they differ";
    if (!(*px > 0.0f)) return "automatic";
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", static_cast<double>(*px));
    return text;
}

void draw_slider(GameWorld& world, ContractState& state, std::optional<float> now) {
    const bool is_said = now.value_or(0.0f) > 0.0f;
    int step = is_said ? contract_step(*now) : 0;
    const std::string shown = px_words(now);
    if (ImGui::SliderInt("max_error_px", &step, kLeastContractStep, kMostContractStep, shown.c_str(),
                         ImGuiSliderFlags_NoInput))
        change(world, state, [&](LightSettings& settings) { settings.shadow.max_error_px = contract_px(step); });
    ImGui::SameLine();
    bool automatic = now && !is_said;
    if (ImGui::Checkbox("automatic", &automatic))
        change(world, state,
               [&](LightSettings& settings) { settings.shadow.max_error_px = automatic ? 0.0f : contract_px(0); });
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("1 px, as far as maps of the usual filter keep it");
}

std::string ms_words(std::optional<float> ms) {
    if (!ms) return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", *ms);
    return text;
}

void draw_points(const std::vector<ContractPoint>& points, std::optional<float> now) {
    constexpr const char* kColumns[] = {"max_error_px",          "drawn ms", "reused ms", "texels", "KiB",
                                        "edges off, px", "frames"};
    const auto flags = ImGuiTableFlags_Borders | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
    if (!ImGui::BeginTable("settings", static_cast<int>(std::size(kColumns)), flags)) return;
    for (const char* column : kColumns) ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    const auto cell = [](const std::string& text) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(text.c_str());
    };
    for (const ContractPoint& point : points) {
        char predicted[32];
        const bool is_now = now && !(*now < point.max_error_px) && !(*now > point.max_error_px);
        const std::string px = (is_now ? "> " : "") + px_words(point.max_error_px);
        std::snprintf(predicted, sizeof predicted, "%.2f", point.predicted_px);
        ImGui::TableNextRow();
        for (const std::string& text :
             {px, ms_words(point.drawn_ms), ms_words(point.kept_ms), std::to_string(point.texels),
              std::to_string(point.bytes / 1024), std::string(predicted), std::to_string(point.frames)})
            cell(text);
    }
    ImGui::EndTable();
}

/// Draws time upward over max_error_px to the right, as far as the slider goes.
void draw_curve(const std::vector<ContractPoint>& points, std::optional<float> now) {
    float most = 0.0f;
    for (const ContractPoint& point : points)
        most = std::max({most, point.drawn_ms.value_or(0.0f), point.kept_ms.value_or(0.0f)});
    char words[96];
    std::snprintf(words, sizeof words, "up: 0 to %.2f ms on the GPU; right: max_error_px",
                  static_cast<double>(kAbove * most));
    ImGui::TextUnformatted(most > 0.0f ? words : "no times measured yet");
    Plot plot(kPlot_px, kAbove * most);
    const auto across = [](float px) {
        return static_cast<float>(contract_step(px) - kLeastContractStep) /
               static_cast<float>(kMostContractStep - kLeastContractStep);
    };
    for (const ContractPoint& point : points) {
        if (!(point.max_error_px > 0.0f)) continue;
        if (point.kept_ms) plot.dot(across(point.max_error_px), *point.kept_ms, kKept);
        if (point.drawn_ms) plot.dot(across(point.max_error_px), *point.drawn_ms, kDrawn);
    }
    if (now && *now > 0.0f) plot.dot(across(*now), 0.0f, kNow);
    ImGui::TextColored(ImColor(kDrawn), "maps drawn");
    ImGui::SameLine();
    ImGui::TextColored(ImColor(kKept), "maps reused");
    ImGui::SameLine();
    ImGui::TextColored(ImColor(kNow), "now");
}

}  // namespace

void note_contract(const GameWorld& world, const FrameReport& report, ContractState& state) {
    if (const auto now = common_px(world, state)) state.curves[state.light].add(*now, report, state.light);
}

void draw_contract(GameWorld& world, ContractState& state) {
    if (!ImGui::CollapsingHeader("accuracy against time")) return;
    ImGui::PushItemWidth(0.6f * kPlot_px.x);
    draw_light_choice(world, state);
    draw_presets(world, state);
    const auto now = common_px(world, state);
    draw_slider(world, state, now);
    ImGui::PopItemWidth();
    if (is_given(world, state)) ImGui::TextUnformatted("resolution is set: max_error_px does not choose these sizes");
    ContractCurve& curve = state.curves[state.light];
    const std::vector<ContractPoint> points = curve.points();
    draw_curve(points, now);
    draw_points(points, now);
    if (ImGui::Button("forget what was measured")) curve.clear();
}

}  // namespace gnomon::game
