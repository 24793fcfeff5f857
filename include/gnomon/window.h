#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "gnomon/result.h"

/// OpenGL 4.5 core context with a picture to draw into, in a window or without one. For examples, tools and tests; an
/// engine brings its own.
namespace gnomon {

/// Keys that Input knows, by what is written on them on an American keyboard.
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
    bool present = false;                                                    // false: all other fields are 0
    float left_x = 0.0f, left_y = 0.0f, right_x = 0.0f, right_y = 0.0f;      // right and down are positive
    float left_trigger = -1.0f, right_trigger = -1.0f;                       // -1 free, 1 pressed
    std::array<bool, static_cast<std::size_t>(PadButton::count)> down = {};  // by PadButton
};
/// Number of slots for gamepads.
inline constexpr std::size_t kMaxGamepads = 16;

/// Maximum number of characters per frame. Neither typing nor key repeat produces more in a slow frame.
inline constexpr std::size_t kMaxTyped = 32;

/// Input since the last frame. Positions in pixels, y down.
struct Input {
    bool down[static_cast<std::size_t>(Key::count)] = {};     // down now, by Key
    bool pressed[static_cast<std::size_t>(Key::count)] = {};  // went down since the last frame
    double mouse_dx = 0.0, mouse_dy = 0.0;                    // way since the last frame
    double mouse_x = 0.0, mouse_y = 0.0;                      // place in the window
    bool mouse_button = false;                                // any button is down
    bool mouse_pressed = false;                       // a button went down since the last frame, even if it is up again
    std::array<Gamepad, kMaxGamepads> gamepads = {};  // by slot
    std::array<char32_t, kMaxTyped> typed = {};       // characters since the last frame, in the keyboard's layout
    std::size_t typed_count = 0;                      // number of them
    bool close_requested = false;                     // the window's own button, or the system
    std::uint32_t framebuffer_width = 0, framebuffer_height = 0;  // 0: minimised
};

/// What a window, or a picture without one, is like.
struct WindowOptions {
    std::string title = "Gnomon";   // shown in its frame
    glm::uvec2 size_px{1280, 720};  // picture's size, each above 0
    bool headless = false;          // no window: EGL, for machines without a display
    std::uint32_t frames = 0;     // number of frames until begin_frame() returns false; 0: until the window is closed.
                                  // Headless: at least 1
    std::string screenshot = {};  // PNG of the last frame; empty: none
    bool own_picture = true;      // false: framebuffer() and its textures are not made; end_frame() gets a picture
};

/// Reads --headless, --size WxH, --frames N and --screenshot F.png. Error ("usage"): anything else, --help included;
/// its message is the usage.
Result<WindowOptions> window_options(int argc, const char* const* argv, std::string_view title);

/// Alpha of a picture. opaque: it does not count. premultiplied: coverage, by which colours are multiplied as light, as
/// FrameSettings::transparent has it.
enum class PictureAlpha : std::uint8_t { opaque, premultiplied };

/// Writes a GL_TEXTURE_2D with channels of 8 bits as a PNG. Row 0 is the lowest, as OpenGL draws. Opaque colours are
/// written as they are stored; others divided by alpha, as PNG has them. Error: "output.write".
Result<bool> write_screenshot(unsigned colour_texture, const std::string& file,
                              PictureAlpha alpha = PictureAlpha::opaque);

/// Window, or picture without one. The context is current on the creating thread until it is destroyed.
class Window {
public:
    /// Errors: "glfw.init", "glfw.window", "egl.display", "egl.context" (no display, or no OpenGL 4.5),
    /// "window.picture".
    static Result<std::unique_ptr<Window>> open(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Begins a frame: reads events, fits the picture to the window, binds framebuffer() and sets the viewport. Returns
    /// false when the window is closed or all frames are drawn; never before the first one.
    bool begin_frame();
    /// Shows the picture, and writes the screenshot in the last frame. `picture`: a GL_TEXTURE_2D of size_px() with
    /// encoded colours to show instead, for example Frame::picture_texture(); 0: colour_texture(). Error:
    /// "output.write".
    Result<bool> end_frame(unsigned picture = 0);

    /// Returns what came since the last frame; nothing without a window.
    const Input& input() const;
    /// Hides the mouse and keeps it in the window, so that it turns a head without end; false: lets it go.
    void capture_mouse(bool on);
    /// Shows a title in the window's frame.
    void set_title(std::string_view title);

    /// Returns the picture's size in this frame; of a minimised window, as it was before.
    glm::uvec2 size_px() const;
    double time_s() const;            // since the first frame; headless, or with a number of frames: 1/60 s per frame
    unsigned framebuffer() const;     // with both textures
    unsigned colour_texture() const;  // GL_SRGB8_ALPHA8: enable GL_FRAMEBUFFER_SRGB to have colours encoded
    unsigned depth_texture() const;   // GL_DEPTH_COMPONENT32F

private:
    struct State;
    explicit Window(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace gnomon
