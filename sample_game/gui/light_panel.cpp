#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

#include "sample_game/gui/gui.h"
#include "sample_game/support/scene/mist.h"
#include "sample_game/support/settings/light_settings.h"
#include "sample_game/support/settings/setting_uses.h"

namespace gnomon::game {
namespace {

/// Draws the editor of `setting`. Returns the new value as a text for its `set`; empty: unchanged.
std::string edited(const LightSetting& setting, const LightSettings& settings) {
    std::string now = setting.get(settings);
    switch (setting.editor) {
        case SettingEditor::toggle: {
            bool on = now == "on";
            if (!ImGui::Checkbox(setting.key, &on)) return {};
            return on ? "on" : "off";
        }
        case SettingEditor::choice: {
            std::string chosen;
            if (!ImGui::BeginCombo(setting.key, now.c_str())) return {};
            for (std::size_t i = 0; !setting.choice(i).empty(); ++i) {
                const std::string name(setting.choice(i));
                if (ImGui::Selectable(name.c_str(), name == now)) chosen = name;
            }
            ImGui::EndCombo();
            return chosen;
        }
        case SettingEditor::text: {
            constexpr std::size_t kMostCharacters = 128;
            std::array<char, kMostCharacters> text{};
            now.copy(text.data(), text.size() - 1);
            const auto flags = ImGuiInputTextFlags_EnterReturnsTrue;
            return ImGui::InputText(setting.key, text.data(), text.size(), flags) ? text.data() : std::string{};
        }
        case SettingEditor::number:
            break;
    }
    float value = std::strtof(now.c_str(), nullptr);
    const char* format = setting.whole ? "%.0f" : "%.4g";
    const auto flags = ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoInput;
    if (!ImGui::SliderFloat(setting.key, &value, 0.0f, static_cast<float>(setting.slider_most), format, flags))
        return {};
    return setting.whole ? std::to_string(std::lround(value)) : std::to_string(value);
}

/// Draws a setting: greyed where it has no effect on this light, with the reason as its tooltip.
void draw_setting(const SettingUse& use, LightKind kind, LightSettings& settings) {
    const LightSetting& setting = *find_setting(use.key);
    const std::string idle(why_idle(use, settings, kind));
    ImGui::BeginDisabled(!idle.empty());
    const std::string text = edited(setting, settings);
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        const std::string usual = setting.get(LightSettings{});
        if (idle.empty())
            ImGui::SetTooltip("%s\nvalues: %s\ndefault: %s", setting.meaning, setting.values, usual.c_str());
        else
            ImGui::SetTooltip("%s\nno effect here: needs %s", setting.meaning, idle.c_str());
    }
    if (!text.empty()) setting.set(settings, text);  // a value that it does not take changes nothing
}

/// Draws the button that sets all of a group to the defaults, greyed where all have them.
void draw_reset(const PurposeGroup& group, LightSettings& settings) {
    const bool untouched = std::all_of(group.settings.begin(), group.settings.end(), [&](const SettingUse& use) {
        return is_default(*find_setting(use.key), settings);
    });
    ImGui::BeginDisabled(untouched);
    if (ImGui::SmallButton("reset")) reset_group(group, settings);
    ImGui::EndDisabled();
}

/// Edits what was opened: at first the group that most scenes need.
void draw_groups(LightKind kind, LightSettings& settings) {
    ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_DefaultOpen;
    for (const PurposeGroup& group : purpose_groups()) {
        const bool open = ImGui::TreeNodeEx(group.name, flags);
        flags = ImGuiTreeNodeFlags_None;
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", group.meaning);
        if (!open) continue;
        draw_reset(group, settings);
        for (const SettingUse& use : group.settings) draw_setting(use, kind, settings);
        ImGui::TreePop();
    }
}

void draw_settings(GameWorld& world) {
    ImGui::TextUnformatted("Settings of each light's shadow:");
    for (const NamedEntity& light : world.scene.lights) {
        if (!world.registry.has<LightShadow>(light.entity) || !ImGui::CollapsingHeader(light.name.c_str())) continue;
        const Light* own = world.registry.get<Light>(light.entity);
        ImGui::PushID(light.name.c_str());
        change_settings(world.registry, light.entity,
                        [&](LightSettings& settings) { draw_groups(own ? own->kind : LightKind::point, settings); });
        ImGui::PopID();
    }
}

void time_cell(const std::optional<double>& time_us) {
    ImGui::TableNextColumn();
    if (time_us)
        ImGui::Text("%.0f", *time_us);
    else
        ImGui::TextUnformatted("-");
}

/// Adds the cells of a light or view: its state, the reason, and what that saved.
void why_cells(LightState state, Reason reason, const Why& why) {
    for (const char* words : {to_text(state), reason_code(reason)}) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(words);
    }
    for (const std::uint64_t n : {std::uint64_t{why.receivers}, std::uint64_t{why.casters}, why.bytes_saved / 1024}) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(std::to_string(n).c_str());
    }
    time_cell(why.saved_us);
}

/// Adds a row for the light's cached visibility.
void kept_row(const LightReport& light) {
    Why why;
    why.saved_us = light.kept.saved_us;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted("pixels");
    why_cells(light.kept.reason == Reason::none ? LightState::rendered : LightState::reused, light.kept.reason, why);
}

/// Draws a row per light. Opened up, it shows a row per view and one for cached visibility.
void draw_why(const FrameReport& report) {
    constexpr std::array kColumns{"view", "state", "reason", "receivers", "casters", "KiB saved", "us saved"};
    const auto flags = ImGuiTableFlags_Borders | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
    if (!ImGui::CollapsingHeader("why a map is drawn, reused or skipped")) return;
    if (!ImGui::BeginTable("why", static_cast<int>(kColumns.size()), flags)) return;
    for (const char* column : kColumns) ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    for (const LightReport& light : report.lights) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const ImGuiTreeNodeFlags leaf = light.views.count == 0 ? ImGuiTreeNodeFlags_Leaf : ImGuiTreeNodeFlags_None;
        const bool open = ImGui::TreeNodeEx(light.name.c_str(), leaf);
        why_cells(light.state, light.reason, light.why);
        if (!open) continue;
        for (const ViewReport& view : report.views_of(light)) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::Text("%u", view.layer);
            why_cells(view.state, view.reason, view.why);
        }
        if (light.kept.bytes > 0) kept_row(light);
        ImGui::TreePop();
    }
    ImGui::EndTable();
}

/// Returns the filter's name and, if another was expected, the reason.
std::string filter_words(const FilterReport& filter) {
    if (filter.filter == ShadowFilter::automatic) return "-";
    const std::string name(to_text(filter.filter));
    return filter.reason == Reason::none ? name : name + " (" + reason_code(filter.reason) + ")";
}

/// Shows how far edges may be off, and from which width of casters on that counts; hovered, in words and in metres.
void error_cell(const LightReport& light) {
    ImGui::TableNextColumn();
    ImGui::Text("%.2f from %.0f", light.predicted_error_px, light.resolved.px);
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("edges are at most %.2f px off\nof casters at least %.1f px (%.3g m) wide",
                          light.predicted_error_px, light.resolved.px, light.resolved.m);
    }
}

void draw_report(const FrameReport& report) {
    constexpr std::array kColumns{"light", "state", "reason", "filter", "texels",
                                  "KiB",   "draws", "CPU us", "GPU us", "edges off, px"};
    const auto flags = ImGuiTableFlags_Borders | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
    if (!ImGui::CollapsingHeader("shadow of each light", ImGuiTreeNodeFlags_DefaultOpen)) return;
    if (!ImGui::BeginTable("report", static_cast<int>(kColumns.size()), flags)) return;
    for (const char* column : kColumns) ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    const auto count = [](std::uint64_t n) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(std::to_string(n).c_str());
    };
    const auto text = [](const char* words) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(words);
    };
    for (const LightReport& light : report.lights) {
        ImGui::TableNextRow();
        text(light.name.c_str());
        text(to_text(light.state));
        text(reason_code(light.reason));
        text(filter_words(light.filter).c_str());
        count(light.counts.texels);
        count(light.counts.bytes / 1024);
        count(light.counts.draws);
        time_cell(light.cpu_us);
        time_cell(light.gpu_us);
        error_cell(light);
    }
    ImGui::EndTable();
}

/// Draws the slider of the mist; at its left end there is none.
void draw_mist(GameWorld& world) {
    constexpr float kMost_per_m = 1.0f;
    const FogVolume* fog = world.mist == ecs::kNull ? nullptr : world.registry.get<FogVolume>(world.mist);
    float mist_per_m = fog ? fog->extinction_per_m : 0.0f;
    ImGui::PushItemWidth(12.0f * ImGui::GetFontSize());
    if (ImGui::SliderFloat("mist", &mist_per_m, 0.0f, kMost_per_m, "%.3f per m", ImGuiSliderFlags_Logarithmic))
        set_mist(world.scene.bounds_ws, mist_per_m, world.mist, world.registry);
    ImGui::PopItemWidth();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("share of light that mist takes per metre; it shows shafts of light");
}

/// Draws the switch that freezes the frame, and the choice of the light with the errors to show.
void draw_frozen_choice(FrozenFrame& frozen, PanelState& state) {
    bool on = frozen.on();
    if (ImGui::Checkbox("mark errors against ray-traced truth (F5)", &on)) state.toggle_frozen = true;
    if (!frozen.on()) return;
    const auto now = frozen.chosen();
    const char* worst = "each pixel's worst";
    ImGui::SameLine();
    ImGui::PushItemWidth(12.0f * ImGui::GetFontSize());
    if (ImGui::BeginCombo("errors of light (F2)", now ? frozen.lights()[*now].name.c_str() : worst)) {
        if (ImGui::Selectable(worst, !now)) frozen.choose({});
        for (std::size_t i = 0; i < frozen.lights().size(); ++i)
            if (ImGui::Selectable(frozen.lights()[i].name.c_str(), now == i)) frozen.choose(i);
        ImGui::EndCombo();
    }
    ImGui::PopItemWidth();
}

/// Returns the picture's part to the right of the current window. Empty, which stands for all of it, if less than a
/// third remains.
gl::Rect beside_panel(glm::uvec2 size_px) {
    const auto right_px = static_cast<std::int32_t>(ImGui::GetWindowPos().x + ImGui::GetWindowSize().x);
    const glm::ivec2 size(size_px);
    const std::int32_t left_px = std::max(right_px, 0);
    if (3 * (size.x - left_px) < size.x) return {};
    return {left_px, 0, size.x - left_px, size.y};
}

}  // namespace

void draw_light_panel(GameWorld& world, const FrameReport& report, glm::uvec2 size_px, FrozenFrame& frozen,
                      PanelState& state) {
    const ImVec2 at{12.0f, 12.0f};
    ImGui::SetNextWindowPos(at, ImGuiCond_Once);
    if (ImGui::Begin("Lights and shadows (F1)", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
        ImGui::Checkbox("shadows", &state.shadows);
        ImGui::SameLine();
        ImGui::Checkbox("freeze fits (F4)", &state.freeze_fits);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("maps stay fitted to the camera as it is now");
        ImGui::SameLine();
        bool moving = state.moving;
        if (ImGui::Checkbox("movement (P)", &moving)) state.toggle_motion = true;
        ImGui::SameLine();
        ImGui::Text("frame %.2f ms, of it shadows %.2f ms on the CPU", report.cpu_us * 1e-3,
                    report.shadow_cpu_us * 1e-3);
        ImGui::Checkbox("smooth picture (F6)", &state.smooth_picture);
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("samples are added up while nothing moves; until then edges are smoothed");
        ImGui::SameLine();
        ImGui::Text("samples per pixel: %u", report.samples);
        draw_mist(world);
        draw_debug_choice(world, report, state);
        draw_frozen_choice(frozen, state);
        draw_report(report);
        draw_light_graph(world, state.graph);
        draw_contract(world, state.contract);
        draw_budget(report, state.budget);
        draw_why(report);
        draw_settings(world);
        state.debug.area = beside_panel(size_px);
    }
    ImGui::End();
}

}  // namespace gnomon::game
