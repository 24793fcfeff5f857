#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sample_game/gui/gui.h"
#include "systems/frame_system.h"

namespace gnomon {

/// A mouse over the panel of lights. Things are found by what is written on them; a label below a light's own header
/// is named by both: {"sun", "resolution"}.
class PanelHand {
public:
    using Label = std::vector<std::string>;

    PanelHand(game::GameWorld& world, FrameSystem& frame, game::Gui& gui, glm::uvec2 size_px)
        : world_(world), frame_(frame), gui_(gui), size_px_(size_px) {}

    /// Clicks on the thing with this label. False: it is not in the panel, or lies where no mouse comes to.
    bool click(const Label& label);
    /// Presses it where it begins and lets go at this share of its width, or beyond an end.
    bool drag(const Label& label, double to_share);
    /// Chooses the entry of this name in a list that is open.
    bool choose(const std::string& entry);

private:
    struct Row {
        double y_px = 0.0, left_px = 0.0, right_px = 0.0;
    };
    void show(double x_px, double y_px, bool down);
    bool press(const std::optional<Row>& row, double from_share, double to_share);
    std::optional<Row> find(unsigned id);
    std::optional<Row> find(const Label& label);

    game::GameWorld& world_;
    FrameSystem& frame_;
    game::Gui& gui_;
    glm::uvec2 size_px_;
};

}  // namespace gnomon
