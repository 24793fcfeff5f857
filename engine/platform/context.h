#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "gnomon/result.h"

namespace gnomon::platform {

/// OpenGL 4.5 core context, current on the creating thread until destroyed.
class Context {
public:
    virtual ~Context() = default;
};

/// Creates a context that needs no window system. Tries EGL on the first hardware device, then Mesa's surfaceless
/// platform, then the default display. LIBGL_ALWAYS_SOFTWARE=1 skips hardware. The context is robust
/// (LOSE_CONTEXT_ON_RESET) where the driver supports that. Errors: rules "egl.display", "egl.context".
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

/// Buttons by their place on an Xbox pad, independent of their labels.
enum class PadButton : std::uint8_t { a, b, x, y, left_bumper, right_bumper, back, start, left, right, count };

/// State of a gamepad. Axes are as the driver reports them, nominally -1 to 1. They may rest off 0 and may be NaN.
struct Gamepad {
    bool present = false;                                                // false: all other fields are 0
    float left_x = 0.0f, left_y = 0.0f, right_x = 0.0f, right_y = 0.0f;  // right and down are positive
    float left_trigger = -1.0f, right_trigger = -1.0f;                   // -1 free, 1 pressed
    std::array<bool, static_cast<std::size_t>(PadButton::count)> down = {};
};
inline constexpr std::size_t kMaxGamepads = 16;  // GLFW_JOYSTICK_LAST + 1

/// Maximum number of characters per poll. Neither typing nor key repeat produces more in a slow frame.
inline constexpr std::size_t kMaxTyped = 32;

/// Input since the last poll. Positions in pixels, y down.
struct Input {
    bool down[static_cast<std::size_t>(Key::count)] = {};
    bool pressed[static_cast<std::size_t>(Key::count)] = {};  // went down since the last poll
    double mouse_dx = 0.0, mouse_dy = 0.0;
    double mouse_x = 0.0, mouse_y = 0.0;
    bool mouse_button = false;                        // any button is down
    bool mouse_pressed = false;                       // a button went down since the last poll, even if it is up again
    std::array<Gamepad, kMaxGamepads> gamepads = {};  // by slot
    std::array<char32_t, kMaxTyped> typed = {};       // characters since the last poll, in the keyboard's layout
    std::size_t typed_count = 0;
    bool close_requested = false;
    std::uint32_t framebuffer_width = 0, framebuffer_height = 0;
};

/// Window with its context; one at a time, created and used on the main thread. Errors: rules "glfw.init",
/// "glfw.window" (no display, no GL 4.5).
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
