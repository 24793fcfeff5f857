#include "tests/system/panel_hand.h"

#include <gtest/gtest.h>
#include <imgui_internal.h>

namespace gnomon {
namespace {

constexpr const char* kWindow = "Lights and shadows (F1)";
constexpr double kFrame_s = 1.0 / 60.0;
// Steps of a search, with ImGui's 13-pixel font: less than half of a row, and less than the narrowest thing, a checkbox
// of 19.
constexpr double kRow_px = 8.0, kColumn_px = 16.0;

unsigned id_of(const PanelHand::Label& label) {
    const ImGuiWindow* window = ImGui::FindWindowByName(kWindow);
    unsigned id = window ? window->ID : 0;
    for (const std::string& part : label) id = ImHashStr(part.c_str(), 0, id);
    return id;
}

}  // namespace

void PanelHand::show(double x_px, double y_px, bool down) {
    Input input;
    input.mouse_x = x_px;
    input.mouse_y = y_px;
    input.mouse_button = down;
    gui_.lay_out(world_, frame_.report(), frame_.debug_labels(), size_px_, &input, kFrame_s);
}

std::optional<PanelHand::Row> PanelHand::find(unsigned id) {
    const auto is_there = [&](double x_px, double y_px) {
        show(x_px, y_px, false);
        return ImGui::GetCurrentContext()->HoveredId == id;
    };
    // Most things begin at the left. The lists of combos may hang out of the panel below, where there is room for more.
    const ImGuiWindow& window = *ImGui::FindWindowByName(kWindow);
    const double right_px = window.Pos.x + window.Size.x;
    for (double x_px = window.Pos.x + 0.5 * kColumn_px; x_px < right_px; x_px += kColumn_px)
        for (double y_px = window.Pos.y + 0.5 * kRow_px; y_px < size_px_.y; y_px += kRow_px) {
            if (!is_there(x_px, y_px)) continue;
            Row row{y_px, x_px, x_px};
            while (is_there(row.right_px + 1.0, y_px)) row.right_px += 1.0;
            while (is_there(row.left_px - 1.0, y_px)) row.left_px -= 1.0;
            return row;
        }
    return std::nullopt;
}

std::optional<PanelHand::Row> PanelHand::find(const Label& label) {
    show(-1.0, -1.0, false);  // what opened in the last frame is laid out
    show(-1.0, -1.0, false);
    return find(id_of(label));
}

bool PanelHand::press(const std::optional<Row>& row, double from_share, double to_share) {
    if (!row) return false;
    const auto at = [&](double share) { return row->left_px + share * (row->right_px - row->left_px); };
    show(at(from_share), row->y_px, false);
    show(at(from_share), row->y_px, true);
    if (from_share < to_share || from_share > to_share) show(at(to_share), row->y_px, true);
    show(at(to_share), row->y_px, false);
    return true;
}

bool PanelHand::click(const Label& label) { return press(find(label), 0.5, 0.5); }

bool PanelHand::drag(const Label& label, double to_share) { return press(find(label), 0.02, to_share); }

bool PanelHand::choose(const std::string& entry) {
    show(-1.0, -1.0, false);
    show(-1.0, -1.0, false);
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    if (context.OpenPopupStack.Size == 0 || !context.OpenPopupStack.back().Window) return false;
    return press(find(ImHashStr(entry.c_str(), 0, context.OpenPopupStack.back().Window->ID)), 0.1, 0.1);
}

}  // namespace gnomon
