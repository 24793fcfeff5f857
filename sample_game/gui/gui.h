#pragma once
#include <imgui.h>

#include <glm/vec2.hpp>
#include <memory>

#include "engine/core/result.h"
#include "engine/gl/device.h"
#include "engine/platform/context.h"
#include "sample_game/app.h"
#include "sample_game/gui/overlay.h"

namespace gnomon::game {

/// What is drawn over the picture: the game's meters and words, and the panel of lights that F1 shows.
class Gui {
public:
    /// Error: rule "gui.device". `device` must outlive it.
    static Result<std::unique_ptr<Gui>> create(gl::Device& device);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    /// Draws over the frame's picture and, if `present`, copies it to the window. The panel changes the world's
    /// LightShadow components at once; they take effect with the next frame. `input`: null without a window.
    void draw(GameWorld& world, Frame& frame, glm::uvec2 size_px, const platform::Input* input, double dt_s,
              bool present);

    bool panel = false;           // shown
    bool shadows = true;          // for FrameSettings
    bool toggle_motion = false;   // the panel's button was pressed; whoever acts on it clears it

private:
    struct Closer {
        void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
    };
    explicit Gui(gl::Device& device) : device_(device) {}

    gl::Device& device_;
    std::unique_ptr<ImGuiContext, Closer> context_;
    std::unique_ptr<Overlay> overlay_;
    gl::CommandList list_;
};

/// The game's meters and, unless it is being played, its state in large letters.
void draw_game_overlay(const GameState& state, glm::vec2 size_px);

/// The panel: switches, the report, and every row of light_settings() for each light that has a LightShadow.
void draw_light_panel(GameWorld& world, const FrameReport& report, bool& shadows, bool& toggle_motion);

}  // namespace gnomon::game
