#include "sample_game/gui/gui.h"

#include <algorithm>

namespace gnomon::game {
namespace {

constexpr float kLeastStep_s = 1.0e-4f;  // ImGui wants time to pass

/// Keys that edit a line of text.
struct EditKey {
    Key key;
    ImGuiKey imgui;
};
constexpr EditKey kEditKeys[] = {{Key::left, ImGuiKey_LeftArrow},
                                 {Key::right, ImGuiKey_RightArrow},
                                 {Key::backspace, ImGuiKey_Backspace},
                                 {Key::enter, ImGuiKey_Enter}};

/// ImGui took keys by tables of the application's own before it took events.
#if IMGUI_VERSION_NUM >= 18700
void set_key(ImGuiIO& io, ImGuiKey key, bool down) { io.AddKeyEvent(key, down); }
#else
void set_key(ImGuiIO& io, ImGuiKey key, bool down) {
    io.KeyMap[key] = key;
    io.KeysDown[key] = down;
}
#endif

void feed(ImGuiIO& io, const Input& input) {
    io.MousePos = {static_cast<float>(input.mouse_x), static_cast<float>(input.mouse_y)};
    io.MouseDown[0] = input.mouse_button || input.mouse_pressed;
    for (const EditKey& edit : kEditKeys) {
        const auto key = static_cast<std::size_t>(edit.key);
        set_key(io, edit.imgui, input.down[key] || input.pressed[key]);
    }
    for (std::size_t i = 0; i < input.typed_count; ++i) io.AddInputCharacter(static_cast<unsigned int>(input.typed[i]));
}

}  // namespace

Gui::Gui() : context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_.get());
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = io.LogFilename = nullptr;  // the game leaves no files behind
    ImGui::StyleColorsDark();
    unsigned char* texels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&texels, &width, &height);  // ImGui lays out by the font that this makes
}

Result<std::unique_ptr<Gui>> Gui::create() {
    auto gui = std::make_unique<Gui>();
    auto overlay = Overlay::create();
    if (!overlay) return overlay.error();
    gui->overlay_ = std::move(overlay).value();
    return gui;
}

Gui::~Gui() = default;

void Gui::lay_out(GameWorld& world, const FrameReport& report, std::span<const debug::Label> labels, glm::uvec2 size_px,
                  const Input* input, double dt_s) {
    ImGui::SetCurrentContext(context_.get());
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(size_px.x), static_cast<float>(size_px.y)};
    io.DeltaTime = std::max(static_cast<float>(dt_s), kLeastStep_s);
    if (input && panel.shown) feed(io, *input);
    ImGui::NewFrame();
    if (world.game) draw_game_overlay(world.game->state(), glm::vec2(size_px), !panel.shown);
    errors_.draw(frozen, report, glm::vec2(size_px));
    draw_debug_labels(labels, glm::vec2(size_px));
    panel.debug.area = {};
    if (panel.shown) {
        panel.graph.add(report);
        note_contract(world, report, panel.contract);
        draw_light_panel(world, report, size_px, frozen, panel);
    } else {
        panel.graph.clear();  // it would have a gap that it does not show
    }
    ImGui::Render();
}

void Gui::draw(GameWorld& world, const Frame& frame, glm::uvec2 size_px, const Input* input, double dt_s) {
    if (!overlay_ || frame.picture_texture() == 0) return;
    lay_out(world, frame.report(), frame.debug_labels(), size_px, input, dt_s);
    overlay_->draw(*ImGui::GetDrawData(), frame.picture_texture(), size_px);
}

}  // namespace gnomon::game
