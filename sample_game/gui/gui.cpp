#include "sample_game/gui/gui.h"

#include <algorithm>

namespace gnomon::game {
namespace {

constexpr float kLeastStep_s = 1.0e-4f;  // ImGui wants time to pass

/// Keys that edit a line of text.
struct EditKey {
    platform::Key key;
    ImGuiKey imgui;
};
constexpr EditKey kEditKeys[] = {{platform::Key::left, ImGuiKey_LeftArrow},
                                 {platform::Key::right, ImGuiKey_RightArrow},
                                 {platform::Key::backspace, ImGuiKey_Backspace},
                                 {platform::Key::enter, ImGuiKey_Enter}};

/// ImGui took keys by tables of the application's own before it took events.
#if IMGUI_VERSION_NUM >= 18700
void set_key(ImGuiIO& io, ImGuiKey key, bool down) { io.AddKeyEvent(key, down); }
#else
void set_key(ImGuiIO& io, ImGuiKey key, bool down) {
    io.KeyMap[key] = key;
    io.KeysDown[key] = down;
}
#endif

void feed(ImGuiIO& io, const platform::Input& input) {
    io.MousePos = {static_cast<float>(input.mouse_x), static_cast<float>(input.mouse_y)};
    io.MouseDown[0] = input.mouse_button || input.mouse_pressed;
    for (const EditKey& edit : kEditKeys) {
        const auto key = static_cast<std::size_t>(edit.key);
        set_key(io, edit.imgui, input.down[key] || input.pressed[key]);
    }
    for (std::size_t i = 0; i < input.typed_count; ++i) io.AddInputCharacter(static_cast<unsigned int>(input.typed[i]));
}

}  // namespace

Result<std::unique_ptr<Gui>> Gui::create(gl::Device& device) {
    std::unique_ptr<Gui> gui(new Gui(device));
    gui->context_.reset(ImGui::CreateContext());
    ImGui::SetCurrentContext(gui->context_.get());
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = io.LogFilename = nullptr;  // the game leaves no files behind
    ImGui::StyleColorsDark();
    auto overlay = Overlay::create(device);
    if (!overlay) return overlay.error();
    gui->overlay_ = std::move(overlay).value();
    return gui;
}

Gui::~Gui() = default;

void Gui::draw(GameWorld& world, FrameSystem& frame, glm::uvec2 size_px, const platform::Input* input, double dt_s,
               bool present) {
    const gl::TargetHandle target = frame.picture_target();
    if (!target) return;
    ImGui::SetCurrentContext(context_.get());
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(size_px.x), static_cast<float>(size_px.y)};
    io.DeltaTime = std::max(static_cast<float>(dt_s), kLeastStep_s);
    if (input && panel.shown) feed(io, *input);
    ImGui::NewFrame();
    if (world.game) draw_game_overlay(world.game->state(), glm::vec2(size_px), !panel.shown);
    errors_.draw(frozen, frame.report(), glm::vec2(size_px));
    draw_debug_labels(frame.debug_labels(), glm::vec2(size_px));
    panel.debug.area = {};
    if (panel.shown) {
        panel.graph.add(frame.report());
        note_contract(world, frame.report(), panel.contract);
        draw_light_panel(world, frame.report(), size_px, frozen, panel);
    } else {
        panel.graph.clear();  // it would have a gap that it does not show
    }
    ImGui::Render();

    list_.clear();
    overlay_->record(*ImGui::GetDrawData(), target, size_px, list_);
    const gl::Rect all{0, 0, static_cast<std::int32_t>(size_px.x), static_cast<std::int32_t>(size_px.y)};
    if (present) list_.add(gl::Blit{target, {}, all, all});
    device_.submit(list_);
}

}  // namespace gnomon::game
