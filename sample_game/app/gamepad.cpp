#include "sample_game/app/gamepad.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace gnomon::game {
namespace {

constexpr float kTriggerPressed = 0.0f;  // half its way

/// Returns the stick's way without its dead zone: length 0 to 1, right and up positive.
glm::dvec2 stick(float x, float down) {
    if (!std::isfinite(x) || !std::isfinite(down)) return glm::dvec2(0.0);
    const glm::dvec2 way(static_cast<double>(x), -static_cast<double>(down));
    const double length = glm::length(way);
    if (!(length > kDeadZone)) return glm::dvec2(0.0);
    return way / length * std::min((length - kDeadZone) / (1.0 - kDeadZone), 1.0);
}

bool down(const Gamepad& pad, PadButton button) { return pad.present && pad.down[static_cast<std::size_t>(button)]; }

GameInput input_of(const Gamepad& before, const Gamepad& now, double dt_s) {
    if (!now.present) return {};
    const auto pressed = [&](PadButton button) { return before.present && !down(before, button) && down(now, button); };
    const glm::dvec2 walk = stick(now.left_x, now.left_y), look = stick(now.right_x, now.right_y);
    return {.forward = walk.y,
            .right = walk.x,
            .yaw_rad = -look.x * kLook_rad_per_s * dt_s,
            .pitch_rad = look.y * kLook_rad_per_s * dt_s,
            .run = now.right_trigger > kTriggerPressed || down(now, PadButton::left_bumper) ||
                   down(now, PadButton::right_bumper),
            .sun = (down(now, PadButton::right) ? 1.0 : 0.0) - (down(now, PadButton::left) ? 1.0 : 0.0),
            .toggle_pause = pressed(PadButton::start),
            .restart = pressed(PadButton::back)};
}

}  // namespace

GameInput together(const GameInput& a, const GameInput& b) {
    const auto sum = [](double x, double y) { return std::clamp(x + y, -1.0, 1.0); };
    return {.forward = sum(a.forward, b.forward),
            .right = sum(a.right, b.right),
            .yaw_rad = a.yaw_rad + b.yaw_rad,
            .pitch_rad = a.pitch_rad + b.pitch_rad,
            .run = a.run || b.run,
            .sun = sum(a.sun, b.sun),
            .toggle_pause = a.toggle_pause || b.toggle_pause,
            .restart = a.restart || b.restart};
}

GameInput gamepad_input(std::span<const Gamepad> before, std::span<const Gamepad> now, double dt_s) {
    GameInput all;
    for (std::size_t slot = 0; slot < now.size(); ++slot)
        all = together(all, input_of(slot < before.size() ? before[slot] : Gamepad{}, now[slot], dt_s));
    return all;
}

}  // namespace gnomon::game
