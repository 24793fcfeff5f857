#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/result.h"

namespace gnomon::platform {

/// An OpenGL 4.5 core debug-capable context, current on the creating thread until destroyed.
class Context {
public:
    virtual ~Context() = default;
};

/// Headless context: EGL on the first hardware device, else surfaceless, else the default display; no window system
/// needed. LIBGL_ALWAYS_SOFTWARE=1 passes over hardware. A robust context (LOSE_CONTEXT_ON_RESET) where the driver
/// has it. Errors: rules "egl.display", "egl.context".
Result<std::unique_ptr<Context>> make_headless_context(bool debug);

enum class Key : std::uint8_t {
    w,
    a,
    s,
    d,
    q,
    e,
    space,
    shift,
    escape,
    p,
    r,
    t,
    f1,
    f2,
    f3,
    f4,
    f5,
    f6,
    f7,
    f8,
    f9,
    f10,
    f11,
    f12,
    left,
    right,
    up,
    down,
    tab,
    enter,
    backspace,
    count
};

/// Buttons as they lie on an Xbox pad, whatever is printed on this one.
enum class PadButton : std::uint8_t { a, b, x, y, left_bumper, right_bumper, back, start, left, right, count };

/// A gamepad now. Axes are what the driver says, at best -1 to 1: it may rest off 0, and may be NaN.
struct Gamepad {
    bool present = false;                                                // all else is 0 without
    float left_x = 0.0f, left_y = 0.0f, right_x = 0.0f, right_y = 0.0f;  // right and down are positive
    float left_trigger = -1.0f, right_trigger = -1.0f;                   // -1 free, 1 pressed
    std::array<bool, static_cast<std::size_t>(PadButton::count)> down = {};
};
inline constexpr std::size_t kMaxGamepads = 16;  // GLFW_JOYSTICK_LAST + 1

/// Characters that one poll reports at most: more than a hand types, or a key repeats, in a slow frame.
inline constexpr std::size_t kMaxTyped = 32;

/// Input since the last poll. Positions in pixels, y down.
struct Input {
    bool down[static_cast<std::size_t>(Key::count)] = {};
    bool pressed[static_cast<std::size_t>(Key::count)] = {};  // went down since the last poll
    double mouse_dx = 0.0, mouse_dy = 0.0;
    double mouse_x = 0.0, mouse_y = 0.0;
    bool mouse_button = false;                        // any button is down
    bool mouse_pressed = false;                       // a button went down since the last poll, even if it is up again
    std::array<Gamepad, kMaxGamepads> gamepads = {};  // by the slot they are plugged into
    std::array<char32_t, kMaxTyped> typed = {};  // characters since the last poll, as the keyboard's layout has them
    std::size_t typed_count = 0;
    bool close_requested = false;
    std::uint32_t framebuffer_width = 0, framebuffer_height = 0;
};

/// A window with its context; one at a time, made and used on the main thread. Errors: rules "glfw.init", "glfw.window"
/// (no display, no GL 4.5).
class Window : public Context {
public:
    virtual const Input& poll() = 0;  // processes events
    virtual void present() = 0;       // swaps
    virtual void capture_mouse(bool on) = 0;
    virtual void set_title(std::string_view title) = 0;
    virtual void* native_handle() = 0;  // GLFWwindow*
};
Result<std::unique_ptr<Window>> make_window(std::uint32_t width, std::uint32_t height, std::string_view title,
                                            bool debug);

}  // namespace gnomon::platform
