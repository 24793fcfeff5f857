#pragma once
#include <imgui.h>

#include <optional>

namespace gnomon::game {

/// A small field with lines in it, where the cursor of the current window stands.
class Plot {
public:
    /// Values of 0 to `most` fill its height.
    Plot(ImVec2 size_px, float most);

    /// A line over the whole width of `count` values; none where `value_of(i)` is empty: lines then have gaps.
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
    /// A level line.
    void level(float value, ImU32 colour);
    void dot(float share_x, float value, ImU32 colour);
    /// Words in its upper left corner.
    void label(const char* text);

private:
    ImVec2 place(float share_x, float value) const;

    ImDrawList& list_;
    ImVec2 at_, size_;
    float most_;
};

}  // namespace gnomon::game
