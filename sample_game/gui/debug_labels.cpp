#include <imgui.h>

#include "sample_game/gui/gui.h"

namespace gnomon::game {

void draw_debug_labels(std::span<const debug::Label> labels, glm::vec2 size_px) {
    constexpr ImU32 kBehind = IM_COL32(10, 10, 14, 200), kInk = IM_COL32(255, 225, 140, 255);
    constexpr float kAir_px = 2.0f;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const debug::Label& label : labels) {
        const ImVec2 at{static_cast<float>(label.at_px.x) + kAir_px,
                        size_px.y - static_cast<float>(label.at_px.y) + kAir_px};
        const ImVec2 wide = ImGui::CalcTextSize(label.text.c_str());
        const float swatch_px = label.swatch ? wide.y : 0.0f,
                    text_px = label.swatch ? swatch_px + 2.0f * kAir_px : 0.0f;
        list.AddRectFilled({at.x - kAir_px, at.y - kAir_px},
                           {at.x + text_px + wide.x + kAir_px, at.y + wide.y + kAir_px}, kBehind);
        if (label.swatch) {
            const glm::vec3& c = *label.swatch;
            list.AddRectFilled(at, {at.x + swatch_px, at.y + swatch_px}, ImColor(c.r, c.g, c.b));
        }
        list.AddText({at.x + text_px, at.y}, kInk, label.text.c_str());
    }
}

}  // namespace gnomon::game
