#pragma once
#include <imgui.h>

#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "gnomon/frame.h"
#include "gnomon/result.h"
#include "gnomon/window.h"
#include "sample_game/game/game_world.h"
#include "sample_game/gui/accuracy_cost_curve.h"
#include "sample_game/gui/error_overlay.h"
#include "sample_game/gui/imgui_renderer.h"
#include "sample_game/gui/light_history.h"
#include "sample_game/inside/truth_comparison.h"

namespace gnomon::game {

/// Light with the max_error_px that the panel shows, and its measured cost so far.
struct ContractState {
    std::string light;                            // empty: all lights
    std::map<std::string, ContractCurve> curves;  // by the light's name, empty for all
};

/// State and switches of the panel. The caller that runs the frame applies them.
struct PanelState {
    bool shown = false;
    bool shadows = true;               // for FrameSettings
    bool moving = true;                // input of draw()
    bool toggle_motion = false;        // request; the caller applies and clears it
    debug::Request debug = {};         // for FrameSettings
    bool freeze_fits = false;          // for FrameSettings
    bool smooth_picture = true;        // for FrameSettings: samples while nothing moves, smooth edges
    shadow::ShadowBudget budget = {};  // for FrameSettings
    bool toggle_frozen = false;        // request; the caller applies and clears it
    LightGraph graph = {};             // history of the frames in which the panel was shown
    ContractState contract = {};
};

/// Overlay of the picture: meters and words of the game, labels of debug views, errors of a frozen frame, and the panel
/// of lights (F1).
class Gui {
public:
    /// Creates the overlay in the current context. Error: rule "gui.device".
    static Result<std::unique_ptr<Gui>> create();
    /// Creates an overlay that is laid out and never drawn, without a context.
    Gui();
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    /// Lays out what is shown over a picture. The panel changes the world's LightShadow components at once; they take
    /// effect with the next frame. `input`: null without a window.
    void lay_out(GameWorld& world, const FrameReport& report, std::span<const debug::Label> labels, glm::uvec2 size_px,
                 const Input* input, double dt_s);
    /// Lays it out, and draws it over the frame's picture.
    void draw(GameWorld& world, const Frame& frame, glm::uvec2 size_px, const Input* input, double dt_s);

    PanelState panel;
    FrozenFrame frozen;

private:
    struct Closer {
        void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
    };

    std::unique_ptr<ImGuiContext, Closer> context_;
    std::unique_ptr<Overlay> overlay_;  // null: never drawn
    ErrorLayer errors_;
};

/// Draws the game's meters and, with `words`, its state in large letters unless it is being played.
void draw_game_overlay(const GameState& state, glm::vec2 size_px, bool words);

/// Draws the labels of a debug view, over the picture and under the panel.
void draw_debug_labels(std::span<const debug::Label> labels, glm::vec2 size_px);

/// Shows the same view of the next light, then none; where none is shown, the first light's depth maps.
void next_debug_light(const GameWorld& world, debug::Request& debug);

/// Shows the next view of the same light, then none.
void next_debug_view(const GameWorld& world, debug::Request& debug);

/// Draws the milliseconds of each light beside its predicted error, frame by frame.
void draw_light_graph(const GameWorld& world, const LightGraph& graph);

/// Draws presets, max_error_px of one light or of all, and its measured cost per setting.
void draw_contract(GameWorld& world, ContractState& state);
/// Adds a frame to the curve of the chosen lights, if they share one max_error_px.
void note_contract(const GameWorld& world, const FrameReport& report, ContractState& state);

/// Draws the sliders of the budget, and what it leaves each light, with the reason.
void draw_budget(const FrameReport& report, shadow::ShadowBudget& budget);

/// Draws the choice of a debug view, its light and its map.
void draw_debug_choice(const GameWorld& world, const FrameReport& report, PanelState& state);

/// Draws the panel: switches, the debug view, the report, and for each light with a LightShadow every row of
/// setting_groups(). Shows debug views beside the panel if there is room.
void draw_light_panel(GameWorld& world, const FrameReport& report, glm::uvec2 size_px, FrozenFrame& frozen,
                      PanelState& state);

}  // namespace gnomon::game
