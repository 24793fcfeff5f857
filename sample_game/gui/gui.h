#pragma once
#include <imgui.h>

#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "engine/core/result.h"
#include "engine/gl/device.h"
#include "engine/platform/context.h"
#include "sample_game/game/game_world.h"
#include "sample_game/gui/accuracy_cost_curve.h"
#include "sample_game/gui/error_overlay.h"
#include "sample_game/gui/imgui_renderer.h"
#include "sample_game/gui/light_history.h"
#include "sample_game/support/truth_comparison.h"

namespace gnomon::game {

/// Of whose max_error_px the panel speaks, and what was measured of it so far.
struct ContractState {
    std::string light;                            // empty: of all
    std::map<std::string, ContractCurve> curves;  // by such a light
};

/// What the panel shows and switches; whoever runs the frame acts on it.
struct PanelState {
    bool shown = false;
    bool shadows = true;               // for FrameSettings
    bool moving = true;                // to be set before draw()
    bool toggle_motion = false;        // asked for; whoever acts on it clears it
    debug::Request debug = {};         // for FrameSettings
    bool freeze_fits = false;          // for FrameSettings
    shadow::ShadowBudget budget = {};  // for FrameSettings
    bool toggle_frozen = false;        // asked for; whoever acts on it clears it
    LightGraph graph = {};             // of the frames in which the panel was shown
    ContractState contract = {};
};

/// What is drawn over the picture: the game's meters and words, those of debug views, errors of a frozen frame, and the
/// panel of lights (F1).
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

    PanelState panel;
    FrozenFrame frozen;

private:
    struct Closer {
        void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
    };
    explicit Gui(gl::Device& device) : device_(device), errors_(device) {}

    gl::Device& device_;
    std::unique_ptr<ImGuiContext, Closer> context_;
    std::unique_ptr<Overlay> overlay_;
    ErrorLayer errors_;
    gl::CommandList list_;
};

/// The game's meters and, with `words`, its state in large letters unless it is being played.
void draw_game_overlay(const GameState& state, glm::vec2 size_px, bool words);

/// The words of a debug view, over the picture and under the panel.
void draw_debug_labels(std::span<const debug::Label> labels, glm::vec2 size_px);

/// Shows the same view of the next light, then none; where none is shown, the first light's depth maps.
void next_debug_light(const GameWorld& world, debug::Request& debug);

/// Shows the next view of the same light, then none.
void next_debug_view(const GameWorld& world, debug::Request& debug);

/// Milliseconds of each light beside its predicted error, frame by frame.
void draw_light_graph(const GameWorld& world, const LightGraph& graph);

/// Presets, max_error_px of one light or of all, and what it was measured to cost, setting by setting.
void draw_contract(GameWorld& world, ContractState& state);
/// Adds a frame to the curve of the lights that are meant, if they have one max_error_px.
void note_contract(const GameWorld& world, const FrameReport& report, ContractState& state);

/// Sliders of the budget, and what it leaves each light, with the reason.
void draw_budget(const FrameReport& report, shadow::ShadowBudget& budget);

/// Which debug view of which light and map is shown.
void draw_debug_choice(const GameWorld& world, const FrameReport& report, PanelState& state);

/// The panel: switches, the debug view, the report, and for each light that has a LightShadow every row of
/// setting_groups(). Debug views are shown beside the panel if there is room.
void draw_light_panel(GameWorld& world, const FrameReport& report, glm::uvec2 size_px, FrozenFrame& frozen,
                      PanelState& state);

}  // namespace gnomon::game
