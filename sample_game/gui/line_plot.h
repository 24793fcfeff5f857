#pragma once
#include <imgui.h>

#include <optional>

namespace gnomon::game {

/// A small field with lines in it, where the cursor of the current window stands.
class Plot {
public:
    /// Creates a plot with values of 0 to `most` over its height.
    Plot(ImVec2 size_px, float most);

    /// Draws a line of `count` values, which ends at the right; the width has room for `room`. An empty `value_of(i)`
    /// leaves a gap.
    template <class ValueOf>
    void line(std::size_t count, std::size_t room, ImU32 colour, const ValueOf& value_of) {
        std::optional<ImVec2> last;
        for (std::size_t i = 0; i < count; ++i) {
            const std::optional<float> value = value_of(i);
            if (!value) {
                last.reset();
                continue;
            }
            const ImVec2 now = place(static_cast<float>(room - count + i) / static_cast<float>(room - 1), *value);
            if (last)
                list_.AddLine(*last, now, colour);
            else
                list_.AddRectFilled(now, {now.x + 1.0f, now.y + 1.0f}, colour);
            last = now;
        }
    }
    /// Draws a level line.
    void level(float value, ImU32 colour);
    void dot(float share_x, float value, ImU32 colour);

private:
    ImVec2 place(float share_x, float value) const;

    ImDrawList& list_;
    ImVec2 at_, size_;
    float most_;
};

}  // namespace gnomon::game
