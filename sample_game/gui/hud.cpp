#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

#include "sample_game/gui/gui.h"
#include "sample_game/gui/keys.h"

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
    float top = 0.34f;  // share of the picture's height
};
Words words_of(Phase phase) {
    switch (phase) {
        case Phase::paused:
            return {"PAUSED", "P goes on, R starts again", kFrame, 0.7f};
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
    const float top = text.top * size_px.y;
    list.AddRectFilled({0.0f, top - 0.3f * large}, {size_px.x, top + 1.4f * large + small}, kBack);
    list.AddText(font, large, {0.5f * (size_px.x - wide.x), top}, text.colour, text.large);
    list.AddText(font, small, {0.5f * (size_px.x - wide_2.x), top + 1.15f * large}, kFrame, text.small);
}

constexpr double kFirstScreen_s = 10.0;
constexpr const char* kTask = "Cross the courtyard to the gate unseen: keep out of the lamps' light.";

/// Draws what to do, and the keys: of all that look at shadows, and of the game.
void draw_first_screen(ImDrawList& list, glm::vec2 size_px) {
    constexpr float kLine = 1.25f, kGap = 1.5f, kTop = 0.06f;  // in letters; share of the picture's height
    constexpr float kLeastFont_px = 8.0f, kMostFont_px = 18.0f, kLinesInPicture = 36.0f;
    ImFont* font = ImGui::GetFont();
    const float font_px = std::clamp(size_px.y / kLinesInPicture, kLeastFont_px, kMostFont_px);
    const auto width_of = [&](const char* text) { return font->CalcTextSizeA(font_px, size_px.x, 0.0f, text).x; };
    float keys_px = 0.0f, words_px = 0.0f, rows = 0.0f;
    for (const KeyRow& row : key_table()) {
        if (row.place == KeyPlace::scene) continue;
        keys_px = std::max(keys_px, width_of(row.keys) + kGap * font_px);
        words_px = std::max(words_px, width_of(row.meaning));
        ++rows;
    }
    const float wide = std::max(width_of(kTask), keys_px + words_px), line_px = kLine * font_px;
    const float left = std::max(0.5f * (size_px.x - wide), font_px);
    float y = kTop * size_px.y;
    list.AddRectFilled({left - font_px, y - 0.5f * font_px},
                       {left + wide + font_px, y + (rows + kGap) * line_px + 0.5f * font_px}, kBack);
    list.AddText(font, font_px, {left, y}, kLight, kTask);
    y += kGap * line_px;
    for (const KeyRow& row : key_table()) {
        if (row.place == KeyPlace::scene) continue;
        list.AddText(font, font_px, {left, y}, kLight, row.keys);
        list.AddText(font, font_px, {left + keys_px, y}, kFrame, row.meaning);
        y += line_px;
    }
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
    const bool begins = state.phase == Phase::playing && state.time_s() < kFirstScreen_s;
    if (begins || state.phase == Phase::paused) draw_first_screen(list, size_px);
}

}  // namespace gnomon::game
