#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

#include "sample_game/gui/gui.h"

namespace gnomon::game {
namespace {

constexpr ImU32 kBack = IM_COL32(10, 10, 14, 170), kFrame = IM_COL32(230, 225, 210, 255);
constexpr ImU32 kLight = IM_COL32(255, 214, 110, 255), kDark = IM_COL32(96, 128, 190, 255);
constexpr ImU32 kSeen = IM_COL32(225, 60, 40, 255), kWon = IM_COL32(120, 220, 120, 255);
constexpr float kMargin = 0.02f, kBarWidth = 0.28f, kBarHeight = 0.03f;  // shares of the picture's height or width

struct Bar {
    const char* label;
    float value, mark;  // 0 ... 1; mark below 0: none
    ImU32 colour;
};

void draw_bar(ImDrawList& list, const Bar& bar, ImVec2 at, ImVec2 size) {
    const ImVec2 end{at.x + size.x, at.y + size.y};
    list.AddRectFilled(at, end, kBack);
    list.AddRectFilled(at, {at.x + size.x * std::clamp(bar.value, 0.0f, 1.0f), end.y}, bar.colour);
    if (bar.mark >= 0.0f) list.AddLine({at.x + size.x * bar.mark, at.y}, {at.x + size.x * bar.mark, end.y}, kFrame);
    list.AddRect(at, end, kFrame);
    list.AddText({end.x + 0.5f * size.y, at.y + 0.5f * (size.y - ImGui::GetFontSize())}, kFrame, bar.label);
}

struct Words {
    const char *large, *small;
    ImU32 colour;
};
Words words_of(Phase phase) {
    switch (phase) {
        case Phase::paused:
            return {"PAUSED", "P goes on, R starts again", kFrame};
        case Phase::won:
            return {"UNSEEN - YOU WIN", "R starts again", kWon};
        case Phase::lost:
            return {"SEEN - YOU LOSE", "R starts again", kSeen};
        case Phase::playing:
            break;
    }
    return {"", "", kFrame};
}

void draw_words(ImDrawList& list, const Words& text, glm::vec2 size_px) {
    if (text.large[0] == '\0') return;
    const float large = std::max(0.12f * size_px.y, ImGui::GetFontSize()), small = std::max(0.25f * large, 13.0f);
    ImFont* font = ImGui::GetFont();
    const ImVec2 wide = font->CalcTextSizeA(large, size_px.x, 0.0f, text.large);
    const ImVec2 wide_2 = font->CalcTextSizeA(small, size_px.x, 0.0f, text.small);
    const float top = 0.34f * size_px.y;
    list.AddRectFilled({0.0f, top - 0.3f * large}, {size_px.x, top + 1.4f * large + small}, kBack);
    list.AddText(font, large, {0.5f * (size_px.x - wide.x), top}, text.colour, text.large);
    list.AddText(font, small, {0.5f * (size_px.x - wide_2.x), top + 1.15f * large}, kFrame, text.small);
}

}  // namespace

void draw_game_overlay(const GameState& state, glm::vec2 size_px, bool words) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float margin = kMargin * size_px.y;
    const ImVec2 size{kBarWidth * size_px.x, std::max(kBarHeight * size_px.y, 8.0f)};
    const std::array bars{Bar{"light", static_cast<float>(state.light), static_cast<float>(kHiddenLight),
                              state.light > kHiddenLight ? kLight : kDark},
                          Bar{"seen", static_cast<float>(state.seen), -1.0f, kSeen}};
    ImVec2 at{margin, size_px.y - margin - size.y};
    for (auto bar = bars.rbegin(); bar != bars.rend(); ++bar) {
        draw_bar(list, *bar, at, size);
        at.y -= 1.5f * size.y;
    }
    if (!words) return;
    draw_words(list, words_of(state.phase), size_px);
    if (state.phase == Phase::playing && state.time_s() < 6.0)
        list.AddText(
            {margin, margin}, kFrame,
            "Reach the gate unseen: keep out of the lamps' light.\n"
            "WASD walk, Shift run, click to look, P pause, R restart, Left/Right sun, F1 lights, F2 depth maps");
}

}  // namespace gnomon::game
