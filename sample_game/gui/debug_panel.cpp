#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sample_game/gui/gui.h"

namespace gnomon::game {
namespace {

constexpr std::string_view kFirstOfLights = "depth";  // what F2 shows where nothing is shown

std::vector<std::string> shadowed_lights(const GameWorld& world) {
    std::vector<std::string> names;
    for (const NamedEntity& light : world.scene.lights)
        if (world.registry.has<LightShadow>(light.entity)) names.push_back(light.name);
    return names;
}

/// Shows `view` of the light that is shown, of another if there is none, or nothing if no light has a shadow.
void show(const debug::ViewRow* view, const std::vector<std::string>& lights, debug::Request& debug) {
    debug.view = lights.empty() ? nullptr : view;
    debug.layer.reset();
    const bool known = std::find(lights.begin(), lights.end(), debug.light) != lights.end();
    const bool any = view && !view->needs_light && debug.light.empty();
    if (!lights.empty() && !known && !any) debug.light = lights.front();
}

void draw_view_choice(const std::vector<std::string>& lights, debug::Request& debug) {
    const std::string now = debug.view ? std::string(debug.view->name) : "none";
    if (!ImGui::BeginCombo("debug view (F3)", now.c_str())) return;
    if (ImGui::Selectable("none", !debug.view)) show(nullptr, lights, debug);
    for (const debug::ViewRow& row : debug::view_table()) {
        if (ImGui::Selectable(std::string(row.name).c_str(), debug.view == &row)) show(&row, lights, debug);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(row.meaning).c_str());
    }
    ImGui::EndCombo();
}

void draw_light_choice(const std::vector<std::string>& lights, debug::Request& debug) {
    if (!ImGui::BeginCombo("of light (F2)", debug.light.empty() ? "all" : debug.light.c_str())) return;
    const auto choose = [&](const std::string& light, const char* label) {
        if (!ImGui::Selectable(label, debug.light == light)) return;
        debug.light = light;
        debug.layer.reset();
    };
    if (!debug.view->needs_light) choose({}, "all");
    for (const std::string& light : lights) choose(light, light.c_str());
    ImGui::EndCombo();
}

void draw_map_choice(std::uint32_t views, debug::Request& debug) {
    if (!ImGui::BeginCombo("map", debug.layer ? std::to_string(*debug.layer).c_str() : "all")) return;
    if (ImGui::Selectable("all", !debug.layer)) debug.layer.reset();
    for (std::uint32_t i = 0; i < views; ++i)
        if (ImGui::Selectable(std::to_string(i).c_str(), debug.layer == i)) debug.layer = i;
    ImGui::EndCombo();
}

}  // namespace

void next_debug_light(const GameWorld& world, debug::Request& debug) {
    const std::vector<std::string> lights = shadowed_lights(world);
    if (!debug.view) {
        debug.light.clear();
        show(debug::find_view(kFirstOfLights), lights, debug);
        return;
    }
    const auto shown = std::find(lights.begin(), lights.end(), debug.light);
    const auto next = shown == lights.end() ? lights.begin() : shown + 1;
    debug.layer.reset();
    debug.light = next == lights.end() ? std::string{} : *next;
    if (next == lights.end()) debug.view = nullptr;
}

void next_debug_view(const GameWorld& world, debug::Request& debug) {
    const auto table = debug::view_table();
    const std::size_t next = debug.view ? static_cast<std::size_t>(debug.view - table.data()) + 1 : 0;
    show(next < table.size() ? &table[next] : nullptr, shadowed_lights(world), debug);
}

void draw_debug_choice(const GameWorld& world, const FrameReport& report, PanelState& state) {
    const std::vector<std::string> lights = shadowed_lights(world);
    ImGui::PushItemWidth(10.0f * ImGui::GetFontSize());
    draw_view_choice(lights, state.debug);
    if (state.debug.view) {
        ImGui::SameLine();
        draw_light_choice(lights, state.debug);
        const auto row = std::find_if(report.lights.begin(), report.lights.end(),
                                      [&](const LightReport& light) { return light.name == state.debug.light; });
        if (row != report.lights.end() && row->counts.views > 1) {
            ImGui::SameLine();
            draw_map_choice(row->counts.views, state.debug);
        }
    }
    ImGui::PopItemWidth();
}

}  // namespace gnomon::game
