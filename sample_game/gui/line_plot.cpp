#include "sample_game/gui/line_plot.h"

#include <algorithm>

namespace gnomon::game {
namespace {

constexpr ImU32 kField = IM_COL32(20, 20, 26, 255);
constexpr float kDot_px = 2.5f;

}  // namespace

Plot::Plot(ImVec2 size_px, float most)
    : list_(*ImGui::GetWindowDrawList()), at_(ImGui::GetCursorScreenPos()), size_(size_px), most_(most) {
    list_.AddRectFilled(at_, {at_.x + size_.x, at_.y + size_.y}, kField);
    ImGui::Dummy(size_px);
}

ImVec2 Plot::place(float share_x, float value) const {
    const float share = most_ > 0.0f ? std::clamp(value / most_, 0.0f, 1.0f) : 0.0f;
    return {at_.x + std::clamp(share_x, 0.0f, 1.0f) * (size_.x - 1.0f), at_.y + (1.0f - share) * (size_.y - 1.0f)};
}

void Plot::level(float value, ImU32 colour) {
    if (value <= most_) list_.AddLine(place(0.0f, value), place(1.0f, value), colour);
}

void Plot::dot(float share_x, float value, ImU32 colour) {
    list_.AddCircleFilled(place(share_x, value), kDot_px, colour);
}

}  // namespace gnomon::game
